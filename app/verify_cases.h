// What light transport is certified against: published values, each with its source, and laws that hold exactly.
#pragma once

#include <string_view>
#include <vector>

#include "core/sampling.h"

namespace fathom {

struct Published {
  std::string_view quantity;
  double value;
  double uncertainty;  ///< half a unit of the last printed digit, or 1 σ where the source is itself random
};

/// One computation, whose quantities are compared with published ones in their order.
struct VerifyCase {
  std::string_view name;
  std::vector<Published> published;
  std::string_view source;
  /// Values in the order of `published`.
  std::vector<Estimate> (*compute)(std::uint64_t seed, const SamplingPlan& plan);
};

const std::vector<VerifyCase>& published_cases();  ///< reflectances, transmittances, angles, apparent depths
const std::vector<VerifyCase>& furnace_cases();    ///< conservation of energy

/// How far a value lies from the published one, in standard errors; the published uncertainty counts as a further
/// error.
double deviation(const Estimate& found, const Published& published);

}  // namespace fathom
