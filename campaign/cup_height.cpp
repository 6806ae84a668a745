#include "campaign/cup_height.h"

#include <optional>

#include "core/cup_profile.h"
#include "detector/desk_view.h"
#include "diagnosis/measurement/cloud_sampling.h"

namespace fathom {
namespace {

/// Of a cloud without rows the desk is sought as if it were sampled everywhere alike: a desk of few points has a cup's
/// bottom, a few millimetres higher and of many points, in its fit.
std::optional<DeskView> view_of_desk(const Cloud& cloud, const LaboratoryRig& rig) {
  const PlaneSearch search;
  Points points = finite_points(cloud);
  const std::vector<PlaneFit> planes =
      find_planes(cloud.height > 1 ? points : thinned_evenly(points, rig.focal_px), search);
  const auto desk = choose_desk(planes, DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad}, search);
  if (!desk) return std::nullopt;
  return view_over(*desk, std::move(points));
}

/// The candidate nearest to where the cup stands, if it is nearer than the cup's outer radius.
std::optional<CupCandidate> candidate_at(const DeskView& view, const Eigen::Vector2d& place, double within_m) {
  std::optional<CupCandidate> nearest;
  const auto distance = [&](const CupCandidate& candidate) { return (candidate.circle->center - place).norm(); };
  for (CupCandidate& candidate : cup_candidates(view, PaperConfig{})) {
    if (!candidate.rejected.empty() || distance(candidate) > within_m) continue;
    if (!nearest || distance(candidate) < distance(*nearest)) nearest = std::move(candidate);
  }
  return nearest;
}

/// The circle is fitted at one height: of a cup whose walls lean it is drawn in by so much more as the inside is
/// narrower elsewhere.
InteriorSettings clear_of_walls(const CupProfile& cup) {
  InteriorSettings settings;
  settings.margin_m += cup.inner_radius(kRadiiAt_m) - cup.narrowest();
  return settings;
}

}  // namespace

std::string_view name_of(NoHeight reason) {
  switch (reason) {
    case NoHeight::no_desk:
      return "no desk is seen";
    case NoHeight::no_cup:
      return "no cup is seen where it should stand";
    case NoHeight::too_little_inside:
      break;
  }
  return "too few points are seen inside the cup";
}

std::variant<InteriorHeight, NoHeight> height_in_cup(const Cloud& cloud, const LaboratoryRig& rig,
                                                     const Eigen::Vector2d& cup_in_world) {
  const std::optional<DeskView> view = view_of_desk(cloud, rig);
  if (!view) return NoHeight::no_desk;
  // The world's origin is below the middle of the baseline, the desk frame's below the camera at its left end.
  const Eigen::Vector2d cup_in_desk = cup_in_world + Eigen::Vector2d(0.5 * rig.baseline_m, 0.0);
  const std::optional<CupCandidate> cup = candidate_at(*view, cup_in_desk, rig.cup.widest());
  if (!cup) return NoHeight::no_cup;
  const std::optional<InteriorHeight> height = interior_height(view->points, *cup->circle, clear_of_walls(rig.cup));
  if (!height) return NoHeight::too_little_inside;
  return *height;
}

}  // namespace fathom
