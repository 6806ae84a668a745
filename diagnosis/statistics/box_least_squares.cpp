#include "diagnosis/statistics/box_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace fathom {

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
  }
  return x;
}

}  // namespace fathom
