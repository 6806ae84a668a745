#include "diagnosis/measurement/desk_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/units.h"
#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/variance_excess.h"

namespace fathom {
namespace {

constexpr std::size_t kParts = 3;      // of a campaign: one session is cut into as many, …
constexpr std::size_t kFewest = 4;     // … but for what leaves fewer placements in each
constexpr double kUnexplained = 0.25;  // of the variance that local noise makes: noise reaches across borders

/// What errors of disparity do to the desk's plane: 1/z = q · (x/z, y/z, 1), with errors [px] of the thirds' means that
/// are independent and equal. Per unit of their variance.
struct PlaneErrors {
  std::array<double, 9> mm_per_px;  ///< height of a third of the image above the plane
  double height_mm2, pitch_deg2, roll_deg2;
};

PlaneErrors plane_errors(const LaboratoryRig& rig) {
  constexpr double kThird_px = kImageWidth_px / 3.0, kThirdRow_px = kImageHeight_px / 3.0;
  const Plane desk = plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad});
  const double per_px = 1.0 / (rig.focal_px * rig.baseline_m);  // of 1/z
  PlaneErrors errors{};
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (int third = 0; third < 9; ++third) {
    const Eigen::Vector3d sight((third % 3 - 1) * kThird_px / rig.focal_px,
                                (third / 3 - 1) * kThirdRow_px / rig.focal_px, 1.0);
    constexpr double kLeast = 0.1;  // a sight that hardly meets the desk
    const double z = desk.offset / std::max(-desk.normal.dot(sight), kLeast);
    errors.mm_per_px[third] = mm_from_metres(desk.offset * z * per_px);
    normal += sight * sight.transpose();
  }
  const Eigen::Matrix3d of_q = per_px * per_px * normal.inverse();
  // Height 1/|q|, pitch and roll as named_values() has them, by their derivatives.
  const Eigen::Vector3d q = -desk.normal / desk.offset;
  const auto variance = [&](const auto& value) {
    Eigen::Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-5 * q.norm() * Eigen::Vector3d::Unit(axis);
      gradient[axis] = (value(q + step) - value(q - step)) / (2.0 * step.norm());
    }
    return gradient.dot(of_q * gradient);
  };
  errors.height_mm2 = variance([](const Eigen::Vector3d& p) { return mm_from_metres(1.0 / p.norm()); });
  errors.pitch_deg2 = variance([](const Eigen::Vector3d& p) { return deg_from_radians(std::asin(p.z() / p.norm())); });
  errors.roll_deg2 = variance([](const Eigen::Vector3d& p) { return deg_from_radians(std::atan2(p.x(), p.y())); });
  return errors;
}

/// The same [mm²] over the variance [px²] of bands of rows with independent errors: 1/z = q · (x/z, y/z, 1), of whose
/// last two terms bands tell, and the height is 1/|q|.
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
  double residuals_px2 = 0.0;  ///< sum over thirds of the image
  int thirds = 0;
  double rows = 0.0, columns = 0.0;  ///< [px²]
};
using Placements = std::vector<Scatter>;

std::map<int, Placements> scatter_by_session(const std::vector<Observation>& observations,
                                             const PlaneErrors& of_plane) {
  std::map<int, std::map<std::pair<int, double>, Scatter>> sessions;
  for (const Observation& o : observations) {
    Scatter& scatter = sessions[o.factors.session][{o.factors.placement, o.factors.time_s}];
    scatter.time_s = o.factors.time_s;
    if (o.observable == "desk_height_mm") scatter.height_mm2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_pitch_deg") scatter.pitch_deg2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_roll_deg") scatter.roll_deg2 = o.repeat_sd * o.repeat_sd;
    if (o.observable == "desk_rows_px") scatter.rows = o.value * o.value;
    if (o.observable == "desk_columns_px") scatter.columns = o.value * o.value;
    if (o.observable != "desk_residual_mm") continue;
    const auto third = std::find(kDeskRegionNames.begin(), kDeskRegionNames.end(), o.factors.region);
    if (third == kDeskRegionNames.end()) continue;
    scatter.residuals_px2 += std::pow(o.repeat_sd / of_plane.mm_per_px[third - kDeskRegionNames.begin()], 2);
    ++scatter.thirds;
  }
  std::map<int, Placements> in_time;
  for (const auto& [session, placements] : sessions)
    for (const auto& [key, scatter] : placements)
      if (scatter.residuals_px2 > 0.0 && scatter.columns > 0.0) in_time[session].push_back(scatter);
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

void add_motion(int session, std::span<const Scatter> placements, const PlaneErrors& of_plane, const LaboratoryRig& rig,
                std::vector<Observation>& result) {
  constexpr double kSteps_px = 0.005;  // a row of a level desk lies in one step of 1/8 px, and some rows make a band
  constexpr double kTogether = 4.0;    // bands of one crest
  VarianceExcess waves = mean_excess(placements, [](const Scatter& s) { return s.rows - s.columns; });
  const VarianceExcess noise = mean_excess(placements, [](const Scatter& s) { return s.columns; });
  waves.error = std::hypot(waves.error, kUnexplained * noise.value, kSteps_px * kSteps_px);
  constexpr double kLeft = (9.0 - 3.0) / 9.0;  // of the thirds' variance, once the plane is taken off
  const auto motion = [&](double Scatter::*variance, double per_px2) {
    const auto local = [&](const Scatter& s) { return per_px2 * s.residuals_px2 / (kLeft * s.thirds); };
    VarianceExcess excess = mean_excess(placements, [&](const Scatter& s) { return s.*variance - local(s); });
    excess.error = std::hypot(excess.error, kUnexplained * mean_excess(placements, local).value);
    return excess;
  };
  VarianceExcess wander = motion(&Scatter::height_mm2, of_plane.height_mm2);
  const double of_waves = kTogether * height_over_rows(rig) * std::max(waves.value, 0.0);
  wander.error = std::hypot(wander.error, of_waves);
  const Factors factors{.session = session, .liquid = "none", .region = "desk"};
  const auto count = static_cast<int>(placements.size());
  result.push_back(root_of(wander, "desk_wander_mm", factors, count));
  result.push_back(root_of(waves, "desk_waves_px", factors, count));
  result.push_back(root_of(motion(&Scatter::pitch_deg2, of_plane.pitch_deg2), "desk_pitch_motion_deg", factors, count));
  result.push_back(root_of(motion(&Scatter::roll_deg2, of_plane.roll_deg2), "desk_roll_motion_deg", factors, count));
}

}  // namespace

std::vector<Observation> desk_motion(const std::vector<Observation>& observations, const LaboratoryRig& rig) {
  const PlaneErrors of_plane = plane_errors(rig);
  const std::map<int, Placements> sessions = scatter_by_session(observations, of_plane);
  const std::size_t wanted = sessions.size() < kParts ? kParts / std::max<std::size_t>(sessions.size(), 1) : 1;
  std::vector<Observation> result;
  for (const auto& [session, placements] : sessions) {
    const std::size_t parts = std::min(wanted, placements.size() / kFewest);
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t begin = placements.size() * part / parts, end = placements.size() * (part + 1) / parts;
      add_motion(session, std::span(placements).subspan(begin, end - begin), of_plane, rig, result);
    }
  }
  return result;
}

}  // namespace fathom
