#include "detector/circle.h"

#include <Eigen/Dense>
#include <cmath>

namespace fathom {

std::optional<Circle> fit_circle(const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 3) return std::nullopt;
  const double count = static_cast<double>(points.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) mean += point;
  mean /= count;

  // About the mean the normal equations fall apart: k is the mean of |q|², and the centre solves a 2×2 system.
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d q = point - mean;
    scatter += q * q.transpose();
    moment += q.squaredNorm() * q;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(scatter);
  constexpr double kThinnest = 1e-10;  // of the squared extents: a sagitta of 1e-5 of the chord is a line in float data
  if (axes.eigenvalues()(0) <= kThinnest * axes.eigenvalues()(1)) return std::nullopt;
  const Eigen::Vector2d offset = 0.5 * scatter.inverse() * moment;

  Circle circle{mean + offset, std::sqrt(scatter.trace() / count + offset.squaredNorm()), 0.0};
  double squares = 0.0;
  for (const Eigen::Vector2d& point : points) squares += std::pow((point - circle.center).norm() - circle.radius_m, 2);
  circle.rms_m = std::sqrt(squares / count);
  return circle;
}

}  // namespace fathom
