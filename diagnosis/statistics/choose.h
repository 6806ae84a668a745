// Which set of effects passes all tests: largest among the candidates, confirmed where it was not fitted, worse
// nowhere.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/diagnosis.h"

namespace fathom {

struct Choice {
  Refit fit;
  std::vector<NamedEffect> effects;  ///< with their evidence, without parameters
};

/// The likeliest set that passes all tests, among those that are not much less likely than the first, and its subsets.
/// `fits`: likeliest first.
std::optional<Choice> choose(const Case& c, const std::vector<Refit>& fits);

}  // namespace fathom
