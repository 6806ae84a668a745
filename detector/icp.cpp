#include "detector/icp.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

#include "detector/nearest.h"

namespace fathom {
namespace {

struct Alignment {
  double mean_distance_m;
  int iterations;
};

/// Besl & McKay (1992): each point's nearest is its counterpart, the rigid motion onto these is the best in the least
/// squares, until the counterparts stay.
Alignment align(Points points, const NearestPoints& target, int iterations_max) {
  std::vector<int> counterparts(points.size(), 0);
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix3Xd from(3, count), to(3, count);
  const auto look_up = [&] {
    bool changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int nearest = target.nearest(points[i], counterparts[i]);
      changed |= nearest != counterparts[i];
      counterparts[i] = nearest;
    }
    return changed;
  };
  int iterations = 0;
  while (look_up() && iterations < iterations_max) {
    ++iterations;
    for (Eigen::Index i = 0; i < count; ++i) {
      from.col(i) = points[i].cast<double>();
      to.col(i) = target.point(counterparts[i]).cast<double>();
    }
    const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
    for (Eigen::Index i = 0; i < count; ++i)
      points[i] = (motion.topLeftCorner<3, 3>() * from.col(i) + motion.topRightCorner<3, 1>()).cast<float>();
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += (points[i] - target.point(counterparts[i])).norm();
  return {sum / static_cast<double>(points.size()), iterations};
}

}  // namespace

std::optional<TemplateMatch> match_templates(const CupCandidate& candidate, const std::vector<CupTemplate>& templates,
                                             const IcpSettings& settings) {
  assert(candidate.circle && !candidate.points.empty());
  const Points segment = thinned(in_template_frame(candidate.points, *candidate.circle));
  std::optional<TemplateMatch> best;
  for (std::size_t i = 0; i < templates.size(); ++i) {
    const Alignment aligned = align(segment, NearestPoints(templates[i].points), settings.iterations_max);
    if (!best || aligned.mean_distance_m < best->score_m)
      best = TemplateMatch{i, aligned.mean_distance_m, aligned.iterations};
  }
  return best;
}

}  // namespace fathom
