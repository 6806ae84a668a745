#include "diagnosis/predict/predictable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

#include "core/estimate.h"

namespace fathom {
namespace {

constexpr std::array<std::string_view, 12> kOfPlacements{
    "height_mm",      "stray_share",           "cup_x_mm",
    "cup_y_mm",       "cup_radius_mm",         "desk_height_mm",
    "log_brightness", "log_ir_contrast",       "desk_wander_mm",
    "desk_waves_px",  "desk_pitch_motion_deg", "desk_roll_motion_deg"};
constexpr std::array<std::string_view, 7> kOfSessions{"desk_pitch_deg", "desk_roll_deg", "desk_residual_mm",
                                                      "comb_strength",  "comb_quarter",  "comb_half",
                                                      "millimetre_comb"};

constexpr std::array<std::string_view, 4> kOnlyName{"comb_strength", "millimetre_comb", "log_brightness",
                                                    "log_ir_contrast"};

bool is_comb(const Observation& o) { return o.observable == "comb_strength" || o.observable == "millimetre_comb"; }

/// Raw shifts, OpenNI's 100 µm mode and floats made of either are the device's depths, too, but not in the steps of its
/// millimetres: there is no law to hold them against.
bool has_whole_millimetres(const std::vector<Observation>& observations) {
  constexpr double kWhole = 0.9;  // mean cosine: 1 apart from rounding
  return std::none_of(observations.begin(), observations.end(),
                      [](const Observation& o) { return o.observable == "millimetre_comb" && o.value < kWhole; });
}

/// What the placements of a session say of its desk: their mean, and as its error how they scatter. A single placement
/// has none of its own; it has that of others. It is predicted for the placement in the middle of their times.
Observation mean_over_placements(const std::vector<const Observation*>& placements) {
  Mean values, times;
  for (const Observation* placement : placements) values.add(placement->value), times.add(placement->factors.time_s);
  const double middle_s = times.estimate().value;
  Observation mean = **std::min_element(placements.begin(), placements.end(), [&](const auto* a, const auto* b) {
    return std::abs(a->factors.time_s - middle_s) < std::abs(b->factors.time_s - middle_s);
  });
  mean.is_of_session = true;
  mean.repeats = static_cast<int>(placements.size());
  mean.repeat_sd = 0.0;
  if (mean.repeats > 1) {
    const Estimate estimate = values.estimate();
    mean.value = estimate.value;
    mean.repeat_sd = estimate.standard_error * std::sqrt(static_cast<double>(mean.repeats));
  }
  return mean;
}

}  // namespace

std::vector<Observation> predictable(const std::vector<Observation>& observations) {
  using SessionDesk = std::tuple<int, bool, std::string, std::string>;
  const auto desk_of = [](const Observation& o) {
    return SessionDesk(o.factors.session, o.factors.liquid == "none", o.observable, o.factors.region);
  };
  const auto is_in = [](const Observation& o, const auto& names) {
    return std::find(names.begin(), names.end(), o.observable) != names.end();
  };
  std::map<SessionDesk, std::vector<const Observation*>> desks;
  bool is_repeated = false;
  for (const Observation& observation : observations) {
    if (!is_in(observation, kOfSessions)) continue;
    std::vector<const Observation*>& placements = desks[desk_of(observation)];
    placements.push_back(&observation);
    is_repeated |= placements.size() > 1;
  }
  const bool has_law = has_whole_millimetres(observations);
  std::vector<Observation> result;
  for (const Observation& observation : observations) {
    if (is_comb(observation) && !has_law) continue;
    const bool is_of_session = is_in(observation, kOfSessions);
    if (is_of_session ? desks[desk_of(observation)].front() != &observation : !is_in(observation, kOfPlacements))
      continue;
    result.push_back(is_of_session && is_repeated ? mean_over_placements(desks[desk_of(observation)]) : observation);
    result.back().only_names = is_in(observation, kOnlyName);
  }
  return result;
}

}  // namespace fathom
