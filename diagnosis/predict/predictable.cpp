#include "diagnosis/predict/predictable.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <tuple>

namespace fathom {
namespace {

constexpr std::array<std::string_view, 11> kOfPlacements{
    "height_mm",           "cup_x_mm",        "cup_y_mm",       "cup_radius_mm", "desk_height_mm",
    "log_brightness",      "log_ir_contrast", "desk_wander_mm", "desk_waves_px", "desk_pitch_motion_deg",
    "desk_roll_motion_deg"};
constexpr std::array<std::string_view, 7> kOfSessions{"desk_pitch_deg", "desk_roll_deg", "desk_residual_mm",
                                                      "comb_strength",  "comb_quarter",  "comb_half",
                                                      "millimetre_comb"};

constexpr std::array<std::string_view, 6> kOnlyName{"comb_strength",   "comb_quarter",   "comb_half",
                                                    "millimetre_comb", "log_brightness", "log_ir_contrast"};

bool is_comb(const Observation& o) { return o.observable == "comb_strength" || o.observable == "millimetre_comb"; }

/// Raw shifts, OpenNI's 100 µm mode and floats made of either are the device's depths, too, but not in the steps of its
/// millimetres: there is no law to hold them against.
bool has_whole_millimetres(const std::vector<Observation>& observations) {
  constexpr double kWhole = 0.9;  // mean cosine: 1 apart from rounding
  return std::none_of(observations.begin(), observations.end(),
                      [](const Observation& o) { return o.observable == "millimetre_comb" && o.value < kWhole; });
}

}  // namespace

std::vector<Observation> predictable(const std::vector<Observation>& observations) {
  std::set<std::tuple<int, bool, std::string, std::string>> seen;
  const bool has_law = has_whole_millimetres(observations);
  std::vector<Observation> result;
  for (const Observation& observation : observations) {
    const auto is_in = [&](const auto& names) {
      return std::find(names.begin(), names.end(), observation.observable) != names.end();
    };
    if (is_comb(observation) && !has_law) continue;
    const Factors& f = observation.factors;
    const bool is_new_in_session =
        is_in(kOfSessions) && seen.emplace(f.session, f.liquid == "none", observation.observable, f.region).second;
    if (!is_new_in_session && !is_in(kOfPlacements)) continue;
    result.push_back(observation);
    result.back().only_names = is_in(kOnlyName);
  }
  return result;
}

}  // namespace fathom
