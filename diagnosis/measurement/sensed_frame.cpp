#include "diagnosis/measurement/sensed_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/measurement/cloud_sampling.h"

namespace fathom {

namespace {

bool is_measured(const Eigen::Vector3f& point) { return point.allFinite() && point.z() > 0.0f; }

}  // namespace

std::vector<SensedPoint> sensed_points(const Cloud& cloud, const LaboratoryRig& rig) {
  std::vector<SensedPoint> points;
  points.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (is_measured(cloud.points[i]))
      points.push_back({cloud.points[i], cloud.intensity.empty() ? 0.0f : cloud.intensity[i]});
  // An image of another size may be thinned, or cut out.
  const bool is_whole_image =
      cloud.width == static_cast<int>(kImageWidth_px) && cloud.height == static_cast<int>(kImageHeight_px);
  if (!is_whole_image) weigh_by_sampling(points, rig.focal_px);
  return points;
}

std::vector<SensedPoint> with_desk_thinned(const Cloud& cloud, std::vector<SensedPoint> points,
                                           const LaboratoryRig& rig, const FrameView& view) {
  constexpr std::size_t kWhole = 100'000;  // points: of fewer each counts
  constexpr std::size_t kEvery = 7;        // neighbours share their noise, 8 px along rows; widths of images share no 7
  constexpr double kPoseError = 0.04;      // [m] of the cup's place; where a rig is off by more its cup is thinned too
  if (points.size() < kWhole) return points;
  const Eigen::Isometry3f to_desk =
      desk_from_camera(plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad})).cast<float>();
  const Eigen::Vector2f axis = view.cup ? Eigen::Vector2f(axis_from_camera(rig, *view.cup).cast<float>())
                                        : Eigen::Vector2f(Eigen::Vector2f::Zero());
  const auto near = view.cup ? static_cast<float>(clear_of_cup(rig) + kPoseError) : 0.0f;
  std::vector<SensedPoint> kept;
  std::size_t number = 0;
  for (std::size_t pixel = 0; pixel < cloud.points.size(); ++pixel) {
    if (!is_measured(cloud.points[pixel])) continue;
    SensedPoint sensed = points[number++];
    if (((to_desk * sensed.point).head<2>() - axis).squaredNorm() >= near * near) {
      if (pixel % kEvery != 0) continue;  // by the pixel, so that all trials show the same ones
      sensed.weight *= static_cast<float>(kEvery);
    }
    kept.push_back(sensed);
  }
  return kept;
}

std::vector<SensedPoint> without_bias(const Cloud& cloud, std::vector<SensedPoint> points, const LaboratoryRig& rig,
                                      const FrameView& view, const BiasField* bias) {
  points = with_desk_thinned(cloud, std::move(points), rig, view);
  if (rig.unit.map) take_off(as_bias(*rig.unit.map), rig, points);
  if (bias) take_off(as_bias(*bias), rig, points);
  return points;
}

FrameView view_of(const FrameRecord& frame) {
  if (frame.bare_desk()) return {};
  return {Eigen::Vector2d(frame.lateral_m, frame.distance_m), frame.fill_m};
}

bool is_near(const Plane& desk, const LaboratoryRig& rig) {
  const PlaneSearch allowed;
  const Plane expected = plane_from({rig.height_m, rig.pitch_rad, rig.roll_rad});
  return desk.normal.dot(expected.normal) > std::cos(allowed.prior_angle_max_rad) &&
         std::abs(desk.offset - expected.offset) < allowed.prior_height_max_m;
}

bool shows_desk(const FrameEstimates& estimates, const LaboratoryRig& rig) {
  constexpr double kFewestPixels = 10.0;
  const double clear = 0.3 * rig.cup.bottom();
  return clear > 0.001 && estimates.interior.weight >= kFewestPixels && estimates.interior.mean < clear;
}

std::string finding_of(const Misplaced& what, const std::vector<std::size_t>& rows, std::size_t clouds,
                       const Table& table, std::string_view which) {
  std::string finding = fmt::format("{} of {} {} {}", rows.size(), clouds, which, what.finding);
  if (2 * rows.size() > clouds) table.fail(rows.front(), what.column, fmt::format("{}, {}", finding, what.wanted));
  return finding;
}

}  // namespace fathom
