#include "diagnosis/statistics/box_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace fathom {
namespace {

/// Towards the minimum over what no bound holds, as far as bounds let it: alone, coordinates that are nearly one
/// another creep.
void move_free(const Eigen::MatrixXd& G, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
               const Eigen::VectorXd& upper, Eigen::VectorXd& x) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    if (lower[k] < x[k] && x[k] < upper[k]) free.push_back(k);
  if (free.empty()) return;
  const Eigen::VectorXd step = G(free, free).llt().solve((b - G * x)(free));
  double share = 1.0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double to_bound = (step[static_cast<Eigen::Index>(i)] > 0.0 ? upper : lower)[free[i]] - x[free[i]];
    if (std::abs(step[static_cast<Eigen::Index>(i)]) > std::abs(to_bound))
      share = std::min(share, to_bound / step[static_cast<Eigen::Index>(i)]);
  }
  x(free) += share * step;
  x = x.cwiseMax(lower).cwiseMin(upper);
}

}  // namespace

Eigen::VectorXd box_least_squares(const Eigen::MatrixXd& G, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
                                  const Eigen::VectorXd& upper) {
  constexpr int kSweeps = 200;
  constexpr double kStill = 1e-9;
  Eigen::VectorXd x = G.llt().solve(b);
  if ((x.array() >= lower.array()).all() && (x.array() <= upper.array()).all()) return x;
  x = x.cwiseMax(lower).cwiseMin(upper);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double moved = 0.0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double best = x[k] + (b[k] - G.row(k).dot(x)) / G(k, k);
      const double next = std::clamp(best, lower[k], upper[k]);
      moved = std::max(moved, std::abs(next - x[k]));
      x[k] = next;
    }
    if (moved < kStill) break;
    move_free(G, b, lower, upper, x);
  }
  return x;
}

}  // namespace fathom
