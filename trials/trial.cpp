#include "trials/trial.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/timed.h"
#include "core/units.h"
#include "sim/scene/rig.h"

namespace fathom {
namespace {

/// A found cup is that cup when their axes are nearer than this: about a third of a cup's radius.
constexpr double kSameAxis = 0.015;
/// A segment is merged when other things give more than this share of its points.
constexpr double kMerged = 0.2;
/// A cup of which less is seen is occluded.
constexpr double kWholeCup = 0.7;

/// Of each thing the number of points that lie on it.
using Owners = std::map<int, int>;

Owners owners_of(const CupCandidate& segment, const Eigen::Isometry3d& camera_from_desk, const LabelledFrame& frame) {
  Owners owners;
  for (const Eigen::Vector3f& point : segment.points) {
    const Eigen::Vector3d in_camera = camera_from_desk * point.cast<double>();
    const Eigen::Vector2d px = frame.focal_px * in_camera.head<2>() / in_camera.z() + frame.principal_px;
    const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
    if (x >= 0 && y >= 0 && x < frame.owners.width() && y < frame.owners.height()) ++owners[frame.owners(x, y)];
  }
  return owners;
}

/// What was found, with who owns the points of every segment.
struct Search {
  const LabelledFrame& frame;
  const Detection& detection;
  Eigen::Isometry3d world_from_desk;
  std::vector<Owners> cups, rejected;
};

Search owned(const LabelledFrame& frame, const Detection& detection) {
  Search result{frame, detection, Eigen::Isometry3d::Identity(), {}, {}};
  if (!detection.desk) return result;
  const Eigen::Isometry3d from_camera = desk_from_camera(detection.desk->plane);
  result.world_from_desk = frame.world_from_camera * from_camera.inverse();
  const auto owners = [&](const CupCandidate& candidate) { return owners_of(candidate, from_camera.inverse(), frame); };
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
    const auto its = owners.find(static_cast<int>(index));
    const int own = its == owners.end() ? 0 : its->second;
    if (own <= most) return;
    most = own;
    int all = 0;
    for (const auto& [owner, count] : owners) all += count;
    cup.why = why;
    merged = all - own > kMerged * all;
  };
  for (std::size_t i = 0; i < search.rejected.size(); ++i)
    look_at(search.rejected[i], search.detection.rejected[i].candidate.rejected);
  for (const Owners& owners : search.cups) look_at(owners, "found elsewhere");
  cup.miss = merged ? Miss::merged : cup.visible < kWholeCup ? Miss::occluded : Miss::refused;
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
std::string name_of_owner(const LabelledFrame& frame, const Owners& owners) {
  const auto most =
      std::max_element(owners.begin(), owners.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == owners.end() || most->first == LabelledFrame::kNobody) return "nothing";
  const auto owner = static_cast<std::size_t>(most->first), cups = frame.cups.size();
  return owner < cups ? frame.cups[owner].shape : frame.others.at(owner - cups);
}

TrialResult compare(const Search& search) {
  TrialResult result;
  result.sensor = search.frame.sensor;
  result.others = static_cast<int>(search.frame.others.size());
  std::vector<bool> used(search.detection.cups.size(), false);
  for (std::size_t index = 0; index < search.frame.cups.size(); ++index) {
    TrialCup cup = search.frame.cups[index];
    std::optional<std::size_t> nearest;
    double least = kSameAxis;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double off = (axis_in_world(search, search.detection.cups[i]) - kMetresPerMm * cup.position_mm).norm();
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
    if (!used[i]) result.false_cups.push_back(name_of_owner(search.frame, search.cups[i]));
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

void CupCounts::add(const TrialCup& cup) {
  ++cups;
  found += cup.found;
  liquid += cup.liquid_found == "yes";
  unknown += cup.liquid_found == "unknown";
  for (std::size_t i = 0; i < kMisses.size(); ++i) missed[i] += cup.miss == kMisses[i];
}

CupCounts& CupCounts::operator+=(const CupCounts& other) {
  cups += other.cups, found += other.found, liquid += other.liquid, unknown += other.unknown;
  for (std::size_t i = 0; i < missed.size(); ++i) missed[i] += other.missed[i];
  false_cups += other.false_cups;
  return *this;
}

CupCounts counts_of(const std::vector<TrialResult>& trials) {
  CupCounts counts;
  for (const TrialResult& trial : trials) {
    for (const TrialCup& cup : trial.cups) counts.add(cup);
    counts.false_cups += static_cast<int>(trial.false_cups.size());
  }
  return counts;
}

DeskPrior prior_of(const Pose& world_from_camera) {
  const Eigen::Matrix3d axes = world_from_camera.linear();
  const double down = std::clamp(-axes(2, 2), -1.0, 1.0);
  return {world_from_camera.translation().z(), std::asin(down), roll_of(axes)};
}

Trial search_trial(const LabelledFrame& frame, const Method& method, DetectorSettings settings) {
  settings.prior = prior_of(frame.world_from_camera);
  double detect_s = 0.0;
  Detection detection = timed(detect_s, [&] { return method.detect(frame.cloud, settings); });
  TrialResult result = compare(owned(frame, detection));
  result.detect_s = detect_s;
  for (const StageTime& stage : detection.stages) result.stages_s.emplace(stage.name, stage.seconds);
  return {std::move(detection), std::move(result)};
}

}  // namespace fathom
