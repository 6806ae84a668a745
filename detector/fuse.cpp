#include "detector/fuse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fathom {
namespace {

struct SeenCup {
  const DetectedCup* cup;
  Eigen::Vector3d in_world;
};

/// Half of the smallest cup's width: closer ones are one cup. Circles lie up to a wall's thickness nearer to the
/// camera.
constexpr double kSameCupMetres = 0.020;

std::vector<std::vector<SeenCup>> group_by_place(const std::vector<PosedDetection>& views) {
  std::vector<std::vector<SeenCup>> groups;
  for (const PosedDetection& view : views)
    for (const DetectedCup& cup : view.detection.cups) {
      const SeenCup seen{&cup, view.world_from_camera * cup.center_in_camera};
      const auto same = std::find_if(groups.begin(), groups.end(), [&](const std::vector<SeenCup>& group) {
        return (group.front().in_world - seen.in_world).norm() < kSameCupMetres;
      });
      if (same == groups.end())
        groups.push_back({seen});
      else
        same->push_back(seen);
    }
  return groups;
}

DetectedCup fused(const std::vector<SeenCup>& group, const Pose& frame_from_world, const Pose& desk_from_frame,
                  const FillSettings& settings) {
  const auto most_certain = std::min_element(group.begin(), group.end(), [](const SeenCup& a, const SeenCup& b) {
    return a.cup->radius_sigma_m.value_or(1.0) < b.cup->radius_sigma_m.value_or(1.0);
  });
  DetectedCup cup = *most_certain->cup;
  double weights = 0.0, radius = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  CupEvidence evidence = cup.evidence.value_or(CupEvidence{});
  evidence.readings.clear();
  for (const SeenCup& seen : group) {
    const double weight = std::pow(seen.cup->radius_sigma_m.value_or(1.0), -2.0);
    weights += weight;
    radius += weight * seen.cup->candidate.circle->radius_m;
    center += weight * seen.in_world;
    if (!seen.cup->evidence) continue;
    const CupEvidence& one = *seen.cup->evidence;
    evidence.readings.insert(evidence.readings.end(), one.readings.begin(), one.readings.end());
    if (one.bottom.sigma_m < evidence.bottom.sigma_m) {
      evidence.bottom = one.bottom;
      evidence.bottom_words = one.bottom_words;
    }
    if (!one.signs.words.empty()) evidence.signs = one.signs;
    if (!one.solid_words.empty()) evidence.solid_words = one.solid_words;
    if (!cup.interior || (seen.cup->interior && seen.cup->interior->points > cup.interior->points)) {
      cup.interior = seen.cup->interior;
      cup.surface_sigma_m = seen.cup->surface_sigma_m;
    }
  }
  cup.center_in_camera = frame_from_world * Eigen::Vector3d(center / weights);
  cup.candidate.circle->radius_m = radius / weights;
  cup.candidate.circle->center = (desk_from_frame * cup.center_in_camera).head<2>();
  cup.candidate.points.clear();  // they are in their own view's frame
  cup.radius_sigma_m = 1.0 / std::sqrt(weights);
  decide_content(cup, evidence, settings);
  if (group.size() > 1) cup.why = fmt::format("seen in {} views; {}", group.size(), cup.why);
  cup.evidence = std::move(evidence);
  return cup;
}

}  // namespace

const PosedDetection& frame_of(const std::vector<PosedDetection>& views) {
  assert(!views.empty());
  const auto frame = std::find_if(views.begin(), views.end(),
                                  [](const PosedDetection& view) { return view.detection.desk.has_value(); });
  return frame == views.end() ? views.front() : *frame;
}

Detection fuse_views(const std::vector<PosedDetection>& views, const DetectorSettings& settings) {
  const PosedDetection& frame = frame_of(views);
  Detection result = frame.detection;
  if (!result.desk) return result;
  result.cups.clear();
  const Pose frame_from_world = frame.world_from_camera.inverse();
  const Pose desk_from_frame = desk_from_camera(result.desk->plane);
  for (const std::vector<SeenCup>& group : group_by_place(views))
    result.cups.push_back(fused(group, frame_from_world, desk_from_frame, settings.robust.fill));
  return result;
}

}  // namespace fathom
