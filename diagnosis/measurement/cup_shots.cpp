#include "diagnosis/measurement/cup_shots.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>

#include "core/parallel.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/sensed_frame.h"

namespace fathom {
namespace {

/// Nothing where the cloud shows no desk.
std::optional<CupShot> cup_shot(const FrameRecord& frame, const Measurement& measurement,
                                const std::filesystem::path& folder) {
  const LaboratoryRig& rig = measurement.rig;
  const Cloud cloud = read_frame_cloud(frame, folder);
  const FrameView view = view_of(frame);
  const std::vector<SensedPoint> sensed = without_bias(cloud, sensed_points(cloud, rig), rig, view,
                                                       measurement.unit ? &measurement.unit->field() : nullptr);
  const std::optional<FrameEstimates> estimates = estimate_frame(sensed, rig, view);
  if (!estimates || !is_near(estimates->desk, rig)) return std::nullopt;
  const Eigen::Vector2d axis = axis_from_camera(rig, *view.cup);
  const Eigen::Isometry3d to_cup = Eigen::Translation3d(-axis.x(), -axis.y(), 0.0) * desk_from_camera(estimates->desk);
  constexpr double kDeskAround = 0.03, kBelow = 0.015, kAbove = 0.02;  // [m]
  const double reach = rig.cup.widest() + kDeskAround, top = rig.cup.height() + kAbove;
  CupShot shot{&frame, {}, to_cup.translation()};
  for (const SensedPoint& point : sensed) {
    const Eigen::Vector3d place = to_cup * point.point.cast<double>();
    if (place.head<2>().norm() < reach && place.z() > -kBelow && place.z() < top)
      shot.points.push_back(place.cast<float>());
  }
  return shot;
}

/// Keeps one point of so many that at most `most` are left.
void thin(Points& points, std::size_t most) {
  const std::size_t every = (points.size() + most - 1) / most;
  if (every <= 1) return;
  Points kept;
  for (std::size_t i = 0; i < points.size(); i += every) kept.push_back(points[i]);
  points = std::move(kept);
}

}  // namespace

std::vector<CupShot> cup_shots(const Measurement& measurement, std::span<const std::filesystem::path> folders,
                               std::size_t most) {
  std::map<std::tuple<std::string, double, double, double>, std::vector<const FrameRecord*>> by_condition;
  for (const FrameRecord& f : measurement.frames)
    if (!f.cloud.empty() && !f.bare_desk()) by_condition[{f.liquid, f.fill_m, f.distance_m, f.lateral_m}].push_back(&f);
  std::vector<std::vector<const FrameRecord*>> conditions;
  for (auto& [condition, frames] : by_condition) conditions.push_back(std::move(frames));
  std::vector<std::optional<CupShot>> shots(conditions.size());
  const std::size_t most_each = most / std::max<std::size_t>(conditions.size(), 1);
  parallel_items(static_cast<int>(conditions.size()), [&](int i) {
    for (auto frame = conditions[i].begin(); frame != conditions[i].end() && !shots[i]; ++frame)
      shots[i] = cup_shot(**frame, measurement, folders[(*frame)->folder]);
    if (shots[i]) thin(shots[i]->points, std::max<std::size_t>(most_each, 1));
  });
  std::vector<CupShot> result;
  for (std::optional<CupShot>& shot : shots)
    if (shot) result.push_back(std::move(*shot));
  return result;
}

}  // namespace fathom
