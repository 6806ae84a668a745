#include "diagnosis/statistics/null_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "diagnosis/statistics/distributions.h"

namespace fathom {

double QuadraticTail::p(double statistic) const { return chi_squared_tail(statistic / scale, dof); }

QuadraticTail fit_quadratic(const Eigen::VectorXd& draws) {
  const double mean = draws.mean();
  const double variance = (draws.array() - mean).square().mean();
  if (variance <= 0.0 || mean <= 0.0) return {};
  return {0.5 * variance / mean, 2.0 * mean * mean / variance};
}

double MaximumTail::p(double statistic) const { return -std::expm1(tests * std::log1p(-normal_tail(statistic))); }

double MaximumTail::quantile(double p) const { return normal_quantile(-std::expm1(std::log1p(-p) / tests)); }

MaximumTail fit_maximum(const Eigen::VectorXd& draws) {
  // Each quantile asks for a number of tests; those at which few draws are left weigh no more than the others.
  constexpr std::array<double, 4> kQuantiles{0.9, 0.95, 0.98, 0.99};
  std::vector<double> sorted(draws.data(), draws.data() + draws.size());
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (const double quantile : kQuantiles) {
    const double z = sorted[static_cast<std::size_t>(quantile * static_cast<double>(sorted.size() - 1))];
    sum += std::log(std::log(quantile) / std::log1p(-normal_tail(z)));
  }
  return {std::exp(sum / static_cast<double>(kQuantiles.size()))};
}

double normal_score(double t, double dof) {
  return (8.0 * dof + 1.0) / (8.0 * dof + 3.0) * std::sqrt(dof * std::log1p(t * t / dof));
}

}  // namespace fathom
