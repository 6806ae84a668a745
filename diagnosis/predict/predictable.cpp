#include "diagnosis/predict/predictable.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <tuple>

namespace fathom {
namespace {

constexpr std::array<std::string_view, 4> kOfPlacements{"height_mm", "desk_height_mm", "log_brightness",
                                                        "desk_wander_mm"};
constexpr std::array<std::string_view, 5> kOfSessions{"desk_pitch_deg", "desk_roll_deg", "desk_residual_mm",
                                                      "comb_strength", "millimetre_comb"};

}  // namespace

std::vector<Observation> predictable(const std::vector<Observation>& observations) {
  std::set<std::tuple<int, bool, std::string, std::string>> seen;
  std::vector<Observation> result;
  for (const Observation& observation : observations) {
    const auto is_in = [&](const auto& names) {
      return std::find(names.begin(), names.end(), observation.observable) != names.end();
    };
    const Factors& f = observation.factors;
    const bool is_new_in_session =
        is_in(kOfSessions) && seen.emplace(f.session, f.liquid == "none", observation.observable, f.region).second;
    if (is_new_in_session || is_in(kOfPlacements)) result.push_back(observation);
  }
  return result;
}

}  // namespace fathom
