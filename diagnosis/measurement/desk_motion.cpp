#include "diagnosis/measurement/desk_motion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/estimate.h"
#include "core/units.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

constexpr double kWholeBand = 25600.0;  // pixels of a whole band of rows
constexpr double kFewestOfBand = 1000.0;
constexpr double kOfPlane = 2.0;  // of a plane's three parameters, each kind of bands feels so many

struct Pooled {
  double sum_px2 = 0.0;  ///< of the bands' variances between trials, each times its pixels
  double seen = 0.0;     ///< bands that are whole enough in all trials
};

template <class Bands>
Pooled pooled(std::span<const DeskBands> trials, Bands DeskBands::*bands) {
  const auto n = static_cast<double>(trials.size());
  Pooled pooled;
  for (std::size_t i = 0; i < std::tuple_size_v<Bands>; ++i) {
    double weight = 0.0, mean = 0.0, squares = 0.0;
    bool in_all = true;
    for (const DeskBands& trial : trials) {
      const RegionEstimate& band = (trial.*bands)[i];
      in_all = in_all && band.weight >= kFewestOfBand;
      weight += band.weight / n;
      mean += band.mean / n;
    }
    if (!in_all) continue;
    for (const DeskBands& trial : trials) squares += std::pow((trial.*bands)[i].mean - mean, 2);
    pooled.sum_px2 += weight * squares / (n - 1.0);
    pooled.seen += 1.0;
  }
  return pooled;
}

/// Mean over bands of the variance between trials [px²], times the pixels of a band and over kWholeBand.
template <class Bands>
std::optional<double> variance_of(std::span<const DeskBands> trials, Bands DeskBands::*bands) {
  const Pooled all = pooled(trials, bands);
  if (all.seen <= 2.0 * kOfPlane) return std::nullopt;
  return all.sum_px2 / (all.seen - kOfPlane) / kWholeBand;
}

struct BandScatter {
  double rows_px = 0.0, columns_px = 0.0;
};

/// Nothing of fewer than two trials, or where too little of the desk is seen in any of them.
std::optional<BandScatter> scatter_of(std::span<const DeskBands> trials) {
  if (trials.size() < 2) return std::nullopt;
  const auto rows = variance_of(trials, &DeskBands::rows), columns = variance_of(trials, &DeskBands::columns);
  if (!rows || !columns) return std::nullopt;
  return BandScatter{std::sqrt(*rows), std::sqrt(*columns)};
}

/// 1/z = q · (x/z, y/z, 1) on a desk.
Eigen::Vector3d inverse_depth(const Plane& desk) { return -desk.normal / desk.offset; }

constexpr double kLevel = 0.1;  // of the desk's normal along the view: a camera that looks along the desk sees none

/// The slope of disparities over the rows, as the pitch [°] of a camera about as high and as steep that makes it. An
/// error that all disparities share leaves it alone.
double turn_deg(const Eigen::Vector3d& q, const Plane& about) {
  return deg_from_radians(q.y() * about.offset / std::max(std::abs(about.normal.z()), kLevel));
}

/// By how much the fitted desk should scatter between trials for the noise of its parts, 1 σ of one trial.
struct PlaneNoise {
  double height_mm = 0.0, turn_deg = 0.0, roll_deg = 0.0;
};

/// Nothing of fewer than two trials or five thirds.
std::optional<PlaneNoise> plane_noise_of(std::span<const DeskBands> trials, const LaboratoryRig& rig) {
  if (trials.size() < 2) return std::nullopt;
  constexpr double kFewestThirds = 5.0, kOfDesk = 3.0;  // the plane takes as many
  const auto n = static_cast<double>(trials.size());
  const Pooled thirds = pooled(trials, &DeskBands::thirds);
  if (thirds.seen < kFewestThirds) return std::nullopt;
  const double of_pixel_px2 = thirds.sum_px2 / (thirds.seen - kOfDesk);  // as if each pixel had an error of its own
  Eigen::Matrix3d sights = Eigen::Matrix3d::Zero();
  for (const DeskBands& trial : trials) sights += trial.sights / n;
  // Errors of q, and of what follows from it by derivatives.
  const double per_px = 1.0 / (rig.focal_px * rig.baseline_m);
  const Eigen::Matrix3d of_q = of_pixel_px2 * per_px * per_px * sights.inverse();
  const Plane& desk = trials.front().desk;
  const Eigen::Vector3d q = inverse_depth(desk);
  const auto error = [&](const auto& value) {
    Eigen::Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-5 * q.norm() * Eigen::Vector3d::Unit(axis);
      gradient[axis] = (value(q + step) - value(q - step)) / (2.0 * step.norm());
    }
    return std::sqrt(gradient.dot(of_q * gradient));
  };
  return PlaneNoise{error([](const Eigen::Vector3d& p) { return mm_from_metres(1.0 / p.norm()); }),
                    error([&](const Eigen::Vector3d& p) { return turn_deg(p, desk); }),
                    error([](const Eigen::Vector3d& p) { return deg_from_radians(std::atan2(p.x(), p.y())); })};
}

constexpr std::size_t kParts = 3;      // of a campaign: one session is cut into as many, …
constexpr std::size_t kFewest = 4;     // … but for what leaves fewer placements in each
constexpr double kUnexplained = 0.25;  // of the variance that local noise makes: noise reaches across borders

/// Between trials of one placement, 1 σ.
double turn_scatter_deg(std::span<const DeskBands> trials) {
  Mean turn;
  for (const DeskBands& trial : trials) turn.add(turn_deg(inverse_depth(trial.desk), trials.front().desk));
  return turn.estimate().standard_error * std::sqrt(static_cast<double>(trials.size()));
}

/// Variances of the desk's height and turn over the variance [px²] of bands of rows with independent errors.
struct PlaneOverRows {
  double height_mm2 = 0.0, turn_deg2 = 0.0;
};

/// Bands tell of the last two parts of q. The height is 1/|q|.
PlaneOverRows plane_over_rows(const LaboratoryRig& rig) {
  constexpr double kRows = std::tuple_size_v<decltype(DeskBands::rows)>;
  const Plane desk = plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad});
  const double mean_square = kImageHeight_px * kImageHeight_px / 12.0 / (rig.focal_px * rig.focal_px);
  const double y2 = desk.normal.y() * desk.normal.y(), z2 = desk.normal.z() * desk.normal.z();
  const double per_px = desk.offset / (rig.focal_px * rig.baseline_m);
  const double height_mm = mm_from_metres(desk.offset * per_px), slope_deg = deg_from_radians(per_px);
  return {height_mm * height_mm * (y2 / mean_square + z2) / kRows,
          slope_deg * slope_deg / (std::max(z2, kLevel * kLevel) * mean_square) / kRows};
}

/// The square of the height by which 1° of turn about the middle row lifts the desk.
double height_mm2_of_turn(const LaboratoryRig& rig) {
  const Plane desk = plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad});
  return std::pow(mm_from_metres(desk.offset) * desk.normal.y() * desk.normal.z() * radians_from_deg(1.0), 2);
}

/// Variances between the trials of one placement.
struct Scatter {
  double time_s = 0.0;
  double height_mm2 = 0.0, turn_deg2 = 0.0, roll_deg2 = 0.0;
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
    if (o.observable == "desk_turn_deg") scatter.turn_deg2 = o.value * o.value;
    if (o.observable == "desk_roll_deg") scatter.roll_deg2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_rows_px") scatter.rows = o.value * o.value;
    if (o.observable == "desk_columns_px") scatter.columns = o.value * o.value;
    if (o.observable == "desk_height_noise_mm") scatter.noise.height_mm = o.value;
    if (o.observable == "desk_turn_noise_deg") scatter.noise.turn_deg = o.value;
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

template <class Of>
double mean_of(std::span<const Scatter> placements, const Of& of) {
  double sum = 0.0;
  for (const Scatter& scatter : placements) sum += of(scatter);
  return sum / static_cast<double>(placements.size());
}

/// Of the mean over placements. `noise`: the variance that is known, of one degree of freedom a placement at least.
template <class Of>
VarianceExcess mean_excess(std::span<const Scatter> placements, double noise, const Of& of) {
  Mean mean;
  for (const Scatter& scatter : placements) mean.add(of(scatter));
  const auto [value, error] = mean.estimate();
  const double by_chance = std::min(error, noise * std::sqrt(2.0 / static_cast<double>(placements.size())));
  return {value, std::hypot(by_chance, kUnexplained * noise), std::sqrt(error * error - by_chance * by_chance)};
}

void add_motion(int session, std::span<const Scatter> placements, const LaboratoryRig& rig,
                std::vector<Observation>& result) {
  constexpr double kSteps_px = 0.005;  // a row of a level desk lies in one step of 1/8 px, and some rows make a band
  constexpr double kTogether = 4.0;    // bands of one crest
  VarianceExcess waves = mean_excess(placements, mean_of(placements, [](const Scatter& s) { return s.columns; }),
                                     [](const Scatter& s) { return s.rows - s.columns; });
  waves.error = std::hypot(waves.error, kSteps_px * kSteps_px);
  const auto motion = [&](double Scatter::*variance, double PlaneNoise::*of_parts) {
    const auto local = [&](const Scatter& s) { return std::pow(s.noise.*of_parts, 2); };
    return mean_excess(placements, mean_of(placements, local),
                       [&](const Scatter& s) { return s.*variance - local(s); });
  };
  // Waves along the rows lift and turn the plane that is fitted, and what turns it lifts it as well.
  VarianceExcess wander = motion(&Scatter::height_mm2, &PlaneNoise::height_mm);
  VarianceExcess pitch = motion(&Scatter::turn_deg2, &PlaneNoise::turn_deg);
  const PlaneOverRows over_rows = plane_over_rows(rig);
  const double of_rows = kTogether * std::max(waves.value, 0.0);
  wander.error =
      std::hypot(wander.error, of_rows * over_rows.height_mm2, std::max(pitch.value, 0.0) * height_mm2_of_turn(rig));
  pitch.error = std::hypot(pitch.error, of_rows * over_rows.turn_deg2);
  const Factors factors{.session = session, .liquid = "none", .region = "desk"};
  const auto count = static_cast<int>(placements.size());
  result.push_back(root_of(wander, "desk_wander_mm", factors, count));
  result.push_back(root_of(waves, "desk_waves_px", factors, count));
  result.push_back(root_of(pitch, "desk_pitch_motion_deg", factors, count));
  result.push_back(root_of(motion(&Scatter::roll_deg2, &PlaneNoise::roll_deg), "desk_roll_motion_deg", factors, count));
}

}  // namespace

Observation root_of(const VarianceExcess& excess, std::string observable, Factors factors, int estimates) {
  Observation root;
  root.observable = std::move(observable);
  root.factors = std::move(factors);
  root.value = std::copysign(std::sqrt(std::abs(excess.value)), excess.value);
  root.repeats = estimates;
  const double size = std::max(std::abs(root.value), 1e-12);
  const double chance = std::min(std::sqrt(excess.error), excess.error / size);
  const double sampling = std::min(std::sqrt(excess.sampling), excess.sampling / (2.0 * size));
  root.repeat_sd = std::hypot(chance, sampling) * std::sqrt(static_cast<double>(estimates));
  return root;
}

std::vector<NamedValue> scatter_values(std::span<const DeskBands> trials, const LaboratoryRig& rig) {
  const auto bands = scatter_of(trials);
  const auto plane = plane_noise_of(trials, rig);
  if (!bands || !plane) return {};
  constexpr std::string_view kDesk = "desk";
  return {{"desk_rows_px", kDesk, bands->rows_px},           {"desk_columns_px", kDesk, bands->columns_px},
          {"desk_height_noise_mm", kDesk, plane->height_mm}, {"desk_turn_deg", kDesk, turn_scatter_deg(trials)},
          {"desk_turn_noise_deg", kDesk, plane->turn_deg},   {"desk_roll_noise_deg", kDesk, plane->roll_deg}};
}

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
