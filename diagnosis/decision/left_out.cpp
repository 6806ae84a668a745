#include "diagnosis/decision/left_out.h"

#include "diagnosis/decision/gap_size.h"
#include "diagnosis/decision/held_out.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {
namespace {

/// Whether observations of the rows tell every parameter.
bool tell_all(const LinearFit& fit, const std::vector<Eigen::Index>& rows) {
  constexpr double kShare = 1e-3;  // of a sensitivity's squared length
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (fit.jacobian.col(k)(rows).squaredNorm() <= kShare * fit.jacobian.col(k).squaredNorm()) return false;
  return true;
}

}  // namespace

std::vector<LeftOutLevel> left_out_levels(const Evidence& evidence, const LinearFit& fit) {
  std::vector<LeftOutLevel> result;
  const auto count = static_cast<Eigen::Index>(evidence.observations.size());
  const Eigen::VectorXd before = measured_minus_predicted(evidence);
  const std::string compared = compared_height(evidence.observations);
  for (const std::string factor : {"liquid", "distance_mm"}) {
    const Groups levels = group_by(evidence.observations, [&](const Observation& o) {
      return o.observable == compared && o.factors.liquid != "none" ? level(o, factor) : std::string();
    });
    const auto members = levels.members();
    for (const std::vector<Eigen::Index>& rows : members) {
      const std::string name = level(evidence.observations[rows.front()], factor);
      std::vector<int> folds(evidence.observations.size(), 1);
      std::vector<Eigen::Index> others;
      for (Eigen::Index row = 0; row < count; ++row)
        if (level(evidence.observations[row], factor) == name)
          folds[row] = 0;
        else
          others.push_back(row);
      if (members.size() < 2 || !tell_all(fit, others)) continue;
      const HeldOut other = held_out(fit, folds);
      result.push_back({factor + "=" + name, gap_size(before, other.residual, other.variance, rows)});
    }
  }
  return result;
}

}  // namespace fathom
