#include "diagnosis/decision/sufficiency.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr std::size_t kFewestObservations = 8;
/// "1 condition", "2 conditions"
std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

bool has_cups(const std::vector<Observation>& observations) {
  return std::any_of(observations.begin(), observations.end(),
                     [](const Observation& o) { return o.factors.liquid != "none"; });
}

/// What would make more conditions of those there are.
std::string_view more_conditions(const std::vector<Observation>& observations) {
  return has_cups(observations) ? "the cup at other known places or with other known fillings would be more"
                                : "all is bare desk: cups at known places, empty or with known fillings, would be "
                                  "more, and of a calibrated sensor (fathom calibrate) one view would do";
}

}  // namespace

std::vector<std::string> missing_for_diagnosis(const Evidence& evidence) {
  std::vector<std::string> missing;
  const auto& observations = evidence.observations;
  const auto conditions = static_cast<std::size_t>(group_by(observations, condition_key).count);
  const bool errors_are_known = evidence.is_calibrated && !has_cups(observations);
  if (observations.size() < kFewestObservations && !errors_are_known)
    missing.push_back(fmt::format("{} (means over trials), at least {} are needed",
                                  counted(observations.size(), "observation"), kFewestObservations));
  if (conditions < kFewestConditions && !errors_are_known)
    missing.push_back(fmt::format("{} (liquid, fill, distance, lateral), at least {} are needed ({})",
                                  counted(conditions, "condition"), kFewestConditions, more_conditions(observations)));
  if (evidence.candidates.empty()) missing.emplace_back("effects to choose from");
  const bool has_repeats =
      std::any_of(observations.begin(), observations.end(), [](const Observation& o) { return o.repeats > 1; });
  const auto replicates = observations.size() - static_cast<std::size_t>(group_by(observations, cell_key).count);
  if (!errors_are_known && !has_repeats && replicates < kFewestReplicates && observations.size() < kEnoughForSmooth)
    missing.push_back(fmt::format(
        "{} measured anew, at least {} tell how large the errors are (pour each filling twice, or measure {} heights)",
        counted(replicates, "observation"), kFewestReplicates, kEnoughForSmooth));
  return missing;
}

}  // namespace fathom
