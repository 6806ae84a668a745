#include "diagnosis/measurement/sensed_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/measurement/sampling.h"

namespace fathom {

std::vector<SensedPoint> sensed_points(const Cloud& cloud, const LaboratoryRig& rig) {
  std::vector<SensedPoint> points;
  points.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (cloud.points[i].allFinite() && cloud.points[i].z() > 0.0f)
      points.push_back({cloud.points[i], cloud.intensity.empty() ? 0.0f : cloud.intensity[i]});
  if (cloud.height <= 1) weigh_by_sampling(points, rig.focal_px);
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
