#include "trials/clutter_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/timed.h"
#include "core/units.h"
#include "sim/render/intersect.h"
#include "sim/scene/cup.h"

namespace fathom {
namespace {

/// A found cup is that cup when their axes are nearer than this: about a third of a cup's radius.
constexpr double kSameAxis = 0.015;
/// A segment is merged when other things give more than this share of its points.
constexpr double kMerged = 0.2;
/// A cup of which less is seen is occluded.
constexpr double kWholeCup = 0.7;

/// Of each object the number of pixels, or of points, that lie on it.
using Owners = std::map<int, int>;

/// How many lie on cup `index`, or on what is in it.
int count_on_cup(const Geometry& geometry, const Owners& owners, std::size_t index) {
  const std::string prefix = fmt::format("cup {} ", index);
  int on_cup = 0;
  for (const auto& [object, count] : owners)
    if (object > 0 && geometry.objects[object - 1].starts_with(prefix)) on_cup += count;
  return on_cup;
}

int pixels_of_cup(const Geometry& geometry, const Image<TruePixel>& truth, std::size_t index) {
  Owners owners;
  for (const TruePixel& pixel : truth.pixels()) ++owners[pixel.object];
  return count_on_cup(geometry, owners, index);
}

/// The share of a cup that other things leave in sight.
double visible_share(const Setup& setup, const Camera& camera, std::size_t cup) {
  Scene alone{.desk = setup.scene.desk, .cups = {setup.scene.cups[cup]}, .objects = {}};
  const Geometry geometry = build_geometry(alone, setup.rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  const PointLight projector(world, setup.rig.projector_in_world());
  const int whole = pixels_of_cup(geometry, trace_truth(projector, setup.rig), 0);
  return whole == 0 ? 0.0 : static_cast<double>(pixels_of_cup(camera.geometry(), camera.truth(), cup)) / whole;
}

Owners owners_of(const CupCandidate& segment, const Eigen::Isometry3d& camera_from_desk, const SensorModel& sensor,
                 const Image<TruePixel>& truth) {
  Owners owners;
  for (const Eigen::Vector3f& point : segment.points) {
    const Eigen::Vector3d in_camera = camera_from_desk * point.cast<double>();
    const Eigen::Vector2d px = sensor.focal_px * in_camera.head<2>() / in_camera.z() + sensor.principal_px;
    const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
    if (x >= 0 && y >= 0 && x < truth.width() && y < truth.height()) ++owners[truth(x, y).object];
  }
  return owners;
}

/// What was found, with who owns the points of every segment.
struct Search {
  const TrialShot& shot;
  const Detection& detection;
  Eigen::Isometry3d world_from_desk;
  std::vector<Owners> cups, rejected;
};

Search owned(const TrialShot& shot, const Detection& detection) {
  Search result{shot, detection, Eigen::Isometry3d::Identity(), {}, {}};
  if (!detection.desk) return result;
  const Rig& rig = shot.setup.rig;
  const Eigen::Isometry3d from_camera = desk_from_camera(detection.desk->plane);
  result.world_from_desk = rig.world_from_camera * from_camera.inverse();
  const auto owners = [&](const CupCandidate& candidate) {
    return owners_of(candidate, from_camera.inverse(), rig.sensor, shot.camera.truth());
  };
  for (const DetectedCup& cup : detection.cups) result.cups.push_back(owners(cup.candidate));
  for (const RejectedSegment& segment : detection.rejected) result.rejected.push_back(owners(segment.candidate));
  return result;
}

Eigen::Vector2d axis_in_world(const Search& search, const DetectedCup& cup) {
  const Eigen::Vector2d& center = cup.candidate.circle->center;
  return (search.world_from_desk * Eigen::Vector3d(center.x(), center.y(), 0.0)).head<2>();
}

void explain_miss(const Search& search, std::size_t index, TrialCup& cup) {
  cup.why = search.detection.desk ? "no segment" : search.detection.why;
  int most = 0;
  bool merged = false;
  const auto look_at = [&](const Owners& owners, const std::string& why) {
    const int own = count_on_cup(search.shot.camera.geometry(), owners, index);
    if (own <= most) return;
    most = own;
    int all = 0;
    for (const auto& [object, count] : owners) all += count;
    cup.why = why;
    merged = all - own > kMerged * all;
  };
  for (std::size_t i = 0; i < search.rejected.size(); ++i)
    look_at(search.rejected[i], search.detection.rejected[i].candidate.rejected);
  for (const Owners& owners : search.cups) look_at(owners, "found elsewhere");
  cup.miss = merged ? Miss::merged : cup.visible < kWholeCup ? Miss::occluded : Miss::refused;
}

TrialCup true_cup(const TrialShot& shot, std::size_t index) {
  const Cup& cup = shot.setup.scene.cups[index];
  TrialCup result;
  result.shape = cup_name(cup);
  result.liquid = cup.filling ? cup.filling->medium.name : "empty";
  result.fill_mm = cup.filling ? mm_from_metres(cup.filling->depth) : 0.0;
  if (cup.filling)
    result.kind = name_of(cup.filling->medium.scatters() ? LiquidKind::kOpaque : LiquidKind::kTransparent);
  result.position_mm = cup.position / kMetresPerMm;
  result.visible = shot.visible[index];
  return result;
}

std::optional<double> in_mm(const std::optional<double>& metres) {
  return metres ? std::optional(mm_from_metres(*metres)) : std::nullopt;
}

void take_over(const DetectedCup& found, TrialCup& cup) {
  cup.found = true;
  cup.liquid_found = name_of(found.liquid);
  cup.p_liquid = found.p_liquid;
  cup.kind_found = name_of(found.kind);
  if (found.interior) cup.surface_mm = mm_from_metres(found.interior->mean_m);
  cup.fill_found_mm = in_mm(found.fill_m);
  cup.fill_sigma_mm = in_mm(found.fill_sigma_m);
}

/// What gives most of the points that were taken for a cup.
std::string name_of_owner(const Search& search, const Owners& owners) {
  const auto most =
      std::max_element(owners.begin(), owners.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == owners.end() || most->first == 0) return "nothing";
  const std::string& name = search.shot.camera.geometry().objects[most->first - 1];
  return name.starts_with("object ") ? name.substr(name.find(' ', 7) + 1) : name;
}

TrialResult compare(const Search& search) {
  TrialResult result;
  std::vector<bool> used(search.detection.cups.size(), false);
  for (std::size_t index = 0; index < search.shot.setup.scene.cups.size(); ++index) {
    TrialCup cup = true_cup(search.shot, index);
    std::optional<std::size_t> nearest;
    double least = kSameAxis;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double off =
          (axis_in_world(search, search.detection.cups[i]) - search.shot.setup.scene.cups[index].position).norm();
      if (!used[i] && off < least) least = off, nearest = i;
    }
    if (nearest) {
      used[*nearest] = true;
      take_over(search.detection.cups[*nearest], cup);
    } else {
      explain_miss(search, index, cup);
    }
    result.cups.push_back(std::move(cup));
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i]) result.false_cups.push_back(name_of_owner(search, search.cups[i]));
  return result;
}

}  // namespace

std::string_view name_of(Miss miss) {
  switch (miss) {
    case Miss::merged:
      return "merged";
    case Miss::occluded:
      return "occluded";
    case Miss::refused:
      break;
  }
  return "refused";
}

DeskPrior prior_of(const Rig& rig) {
  const Eigen::Matrix3d axes = rig.world_from_camera.linear();
  const double down = std::clamp(-axes(2, 2), -1.0, 1.0);
  return {rig.camera_in_world().z(), std::asin(down), roll_of(axes)};
}

TrialShot shoot_trial(const Json& scene, const std::string& file, std::uint64_t seed) {
  double shoot_s = 0.0;
  Setup setup = setup_from_json(scene, file);
  Frame frame;
  Camera camera = timed(shoot_s, [&] {
    Camera result(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, seed, LightModel::direct);
    frame = result.shoot(0);
    return result;
  });
  std::vector<double> visible;
  for (std::size_t cup = 0; cup < setup.scene.cups.size(); ++cup) visible.push_back(visible_share(setup, camera, cup));
  Cloud cloud = cloud_from_image(frame.cloud);
  return {std::move(setup), std::move(camera), std::move(frame), std::move(cloud), std::move(visible), shoot_s};
}

Trial search_trial(const TrialShot& shot, const Method& method, DetectorSettings settings) {
  settings.prior = prior_of(shot.setup.rig);
  double detect_s = 0.0;
  Detection detection = timed(detect_s, [&] { return method.detect(shot.cloud, settings); });
  TrialResult result = compare(owned(shot, detection));
  result.shoot_s = shot.shoot_s;
  result.detect_s = detect_s;
  for (const StageTime& stage : detection.stages) result.stages_s.emplace(stage.name, stage.seconds);
  return {std::move(detection), std::move(result)};
}

}  // namespace fathom
