#include "diagnosis/statistics/sufficiency.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr int kFewestConditions = 3;
constexpr std::size_t kFewestObservations = 8;
constexpr std::size_t kFewestReplicates = 4;
/// From so many on, what a smooth function of the factors leaves tells how large errors are.
constexpr std::size_t kEnoughForSmooth = 24;

}  // namespace

std::vector<std::string> missing_for_diagnosis(const Evidence& evidence) {
  std::vector<std::string> missing;
  const auto& observations = evidence.observations;
  const int conditions = group_by(observations, condition_key).count;
  if (observations.size() < kFewestObservations)
    missing.push_back(fmt::format("{} observations (means over trials), at least {} are needed", observations.size(),
                                  kFewestObservations));
  if (conditions < kFewestConditions)
    missing.push_back(fmt::format("{} conditions (liquid, fill, distance, lateral), at least {} are needed", conditions,
                                  kFewestConditions));
  if (evidence.candidates.empty()) missing.emplace_back("effects to choose from");
  const bool has_repeats =
      std::any_of(observations.begin(), observations.end(), [](const Observation& o) { return o.repeats > 1; });
  const auto replicates = observations.size() - static_cast<std::size_t>(group_by(observations, cell_key).count);
  if (!has_repeats && replicates < kFewestReplicates && observations.size() < kEnoughForSmooth)
    missing.emplace_back("repeats or repeated conditions: nothing says how large the errors are");
  return missing;
}

}  // namespace fathom
