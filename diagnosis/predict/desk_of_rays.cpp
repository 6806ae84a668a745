#include "diagnosis/predict/desk_of_rays.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fathom {
namespace {

constexpr double kAcross_px = kImageWidth_px / kDeskColumns, kDown_px = kImageHeight_px / kDeskRows;

std::size_t place(int column, int row) { return static_cast<std::size_t>(row) * kDeskColumns + column; }

}  // namespace

DeskOfRays::DeskOfRays(std::span<const SensedPoint> desk, const LaboratoryRig& rig)
    : errors_px_(static_cast<std::size_t>(kDeskColumns) * kDeskRows, std::numeric_limits<double>::quiet_NaN()) {
  const double of_inverse = rig.focal_px * rig.baseline_m;
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto sight = [](const SensedPoint& p) { return Eigen::Vector3d(p.point.cast<double>() / p.point.z()); };
  for (const SensedPoint& p : desk) {
    normal += sight(p) * sight(p).transpose();
    right += sight(p) * of_inverse / static_cast<double>(p.point.z());
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  for (const SensedPoint& p : desk) {
    const Eigen::Vector2d pixel = bias_point(p.point, rig).pixel_px;
    const int column = std::clamp(static_cast<int>(pixel.x() / kAcross_px), 0, kDeskColumns - 1),
              row = std::clamp(static_cast<int>(pixel.y() / kDown_px), 0, kDeskRows - 1);
    errors_px_[place(column, row)] = of_inverse / p.point.z() - plane.dot(sight(p));
  }
}

std::optional<double> DeskOfRays::operator()(const BiasCell& cell) const {
  const double x = cell.column_px / kAcross_px - 0.5, y = cell.row_px / kDown_px - 0.5;
  const int left = std::clamp(static_cast<int>(std::floor(x)), 0, kDeskColumns - 2),
            top = std::clamp(static_cast<int>(std::floor(y)), 0, kDeskRows - 2);
  double sum = 0.0, weights = 0.0;
  for (int row = top; row <= top + 1; ++row)
    for (int column = left; column <= left + 1; ++column) {
      const double error = errors_px_[place(column, row)];
      if (std::isnan(error)) continue;
      const double weight = std::max(1.0 - std::abs(x - column), 0.0) * std::max(1.0 - std::abs(y - row), 0.0) + 1e-6;
      sum += weight * error;
      weights += weight;
    }
  if (weights == 0.0) return std::nullopt;
  return sum / weights;
}

}  // namespace fathom
