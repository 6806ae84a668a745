#include "diagnosis/measurement/desk_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/units.h"
#include "diagnosis/measurement/desk_bands.h"
#include "diagnosis/measurement/variance_excess.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

constexpr std::size_t kParts = 3;      // of a campaign: one session is cut into as many, …
constexpr std::size_t kFewest = 4;     // … but for what leaves fewer placements in each
constexpr double kUnexplained = 0.25;  // of the variance that local noise makes: noise reaches across borders

/// Variance of the desk's height [mm²] over the variance [px²] of bands of rows with independent errors: 1/z = q ·
/// (x/z, y/z, 1), of whose last two terms bands tell, and the height is 1/|q|.
double height_over_rows(const LaboratoryRig& rig) {
  constexpr double kRows = std::tuple_size_v<decltype(DeskBands::rows)>;
  const Plane desk = plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad});
  const double mean_square = kImageHeight_px * kImageHeight_px / 12.0 / (rig.focal_px * rig.focal_px);
  const double of_q = (desk.normal.y() * desk.normal.y() / mean_square + desk.normal.z() * desk.normal.z()) / kRows;
  const double height_mm = mm_from_metres(desk.offset * desk.offset / (rig.focal_px * rig.baseline_m));
  return height_mm * height_mm * of_q;
}

/// Variances between the trials of one placement.
struct Scatter {
  double time_s = 0.0;
  double height_mm2 = 0.0, pitch_deg2 = 0.0, roll_deg2 = 0.0;
  PlaneNoise noise;                  ///< what they should be, its squares
  double rows = 0.0, columns = 0.0;  ///< [px²]
};
using Placements = std::vector<Scatter>;

std::map<int, Placements> scatter_by_session(const std::vector<Observation>& observations) {
  std::map<int, std::map<std::pair<std::string, double>, Scatter>> sessions;
  for (const Observation& o : observations) {
    Scatter& scatter = sessions[o.factors.session][{placement_key(o), o.factors.time_s}];
    scatter.time_s = o.factors.time_s;
    if (o.observable == "desk_height_mm") scatter.height_mm2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_pitch_deg") scatter.pitch_deg2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_roll_deg") scatter.roll_deg2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_rows_px") scatter.rows = o.value * o.value;
    if (o.observable == "desk_columns_px") scatter.columns = o.value * o.value;
    if (o.observable == "desk_height_noise_mm") scatter.noise.height_mm = o.value;
    if (o.observable == "desk_pitch_noise_deg") scatter.noise.pitch_deg = o.value;
    if (o.observable == "desk_roll_noise_deg") scatter.noise.roll_deg = o.value;
  }
  std::map<int, Placements> in_time;
  for (const auto& [session, placements] : sessions)
    for (const auto& [key, scatter] : placements)
      if (scatter.noise.height_mm > 0.0 && scatter.columns > 0.0) in_time[session].push_back(scatter);
  for (auto& [session, placements] : in_time)
    std::stable_sort(placements.begin(), placements.end(),
                     [](const Scatter& a, const Scatter& b) { return a.time_s < b.time_s; });
  return in_time;
}

/// Of the mean over placements.
template <class Of>
VarianceExcess mean_excess(std::span<const Scatter> placements, const Of& of) {
  const auto n = static_cast<double>(placements.size());
  double sum = 0.0, squares = 0.0;
  for (const Scatter& scatter : placements) sum += of(scatter);
  for (const Scatter& scatter : placements) squares += std::pow(of(scatter) - sum / n, 2);
  return {sum / n, std::sqrt(squares / (n * (n - 1.0)))};
}

void add_motion(int session, std::span<const Scatter> placements, const LaboratoryRig& rig,
                std::vector<Observation>& result) {
  constexpr double kSteps_px = 0.005;  // a row of a level desk lies in one step of 1/8 px, and some rows make a band
  constexpr double kTogether = 4.0;    // bands of one crest
  VarianceExcess waves = mean_excess(placements, [](const Scatter& s) { return s.rows - s.columns; });
  const VarianceExcess noise = mean_excess(placements, [](const Scatter& s) { return s.columns; });
  waves.error = std::hypot(waves.error, kUnexplained * noise.value, kSteps_px * kSteps_px);
  const auto motion = [&](double Scatter::*variance, double PlaneNoise::*of_parts) {
    const auto local = [&](const Scatter& s) { return std::pow(s.noise.*of_parts, 2); };
    VarianceExcess excess = mean_excess(placements, [&](const Scatter& s) { return s.*variance - local(s); });
    excess.error = std::hypot(excess.error, kUnexplained * mean_excess(placements, local).value);
    return excess;
  };
  VarianceExcess wander = motion(&Scatter::height_mm2, &PlaneNoise::height_mm);
  const double of_waves = kTogether * height_over_rows(rig) * std::max(waves.value, 0.0);
  wander.error = std::hypot(wander.error, of_waves);
  const Factors factors{.session = session, .liquid = "none", .region = "desk"};
  const auto count = static_cast<int>(placements.size());
  result.push_back(root_of(wander, "desk_wander_mm", factors, count));
  result.push_back(root_of(waves, "desk_waves_px", factors, count));
  result.push_back(
      root_of(motion(&Scatter::pitch_deg2, &PlaneNoise::pitch_deg), "desk_pitch_motion_deg", factors, count));
  result.push_back(root_of(motion(&Scatter::roll_deg2, &PlaneNoise::roll_deg), "desk_roll_motion_deg", factors, count));
}

}  // namespace

std::vector<Observation> desk_motion(const std::vector<Observation>& observations, const LaboratoryRig& rig) {
  const std::map<int, Placements> sessions = scatter_by_session(observations);
  const std::size_t wanted = sessions.size() < kParts ? kParts / std::max<std::size_t>(sessions.size(), 1) : 1;
  std::vector<Observation> result;
  for (const auto& [session, placements] : sessions) {
    const std::size_t parts = std::min(wanted, placements.size() / kFewest);
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t begin = placements.size() * part / parts, end = placements.size() * (part + 1) / parts;
      add_motion(session, std::span(placements).subspan(begin, end - begin), rig, result);
    }
  }
  return result;
}

}  // namespace fathom
