#include "diagnosis/statistics/null_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/statistics/distributions.h"

namespace fathom {

double QuadraticTail::p(double statistic) const { return chi_squared_tail(statistic / scale, dof); }

QuadraticTail fit_quadratic(const Eigen::VectorXd& draws) {
  const double mean = draws.mean();
  const double variance = (draws.array() - mean).square().mean();
  if (variance <= 0.0 || mean <= 0.0) return {};
  return {0.5 * variance / mean, 2.0 * mean * mean / variance};
}

double MaximumTail::p(double statistic) const {
  if (statistic <= 0.0) return 1.0;
  const double one = std::min(1.0, 2.0 * student_tail(statistic, dof));
  return one > 0.5 ? 1.0 : -std::expm1(tests * std::log1p(-one));
}

MaximumTail fit_maximum(const Eigen::VectorXd& draws) {
  constexpr std::array<double, 7> kDofs{6, 10, 16, 25, 50, 100, 1000};
  constexpr std::array<double, 4> kQuantiles{0.5, 0.8, 0.95, 0.99};
  std::vector<double> sorted(draws.data(), draws.data() + draws.size());
  std::sort(sorted.begin(), sorted.end());
  MaximumTail best;
  double least = INFINITY;
  for (const double dof : kDofs) {
    // log(number of tests) that each quantile asks for; the shape is right when they agree.
    Eigen::Array<double, kQuantiles.size(), 1> asked;
    for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
      const double z = sorted[static_cast<std::size_t>(kQuantiles[i] * static_cast<double>(sorted.size() - 1))];
      const double one = std::clamp(2.0 * student_tail(std::max(z, 0.0), dof), 1e-300, 1.0 - 1e-12);
      asked[i] = std::log(std::log(kQuantiles[i]) / std::log1p(-one));
    }
    const double spread = (asked - asked.mean()).square().sum();
    if (spread >= least) continue;
    least = spread;
    best = {std::exp(asked.mean()), dof};
  }
  return best;
}

}  // namespace fathom
