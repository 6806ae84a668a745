#include "diagnosis/unit/pixel_noise.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "core/image.h"

namespace fathom {
namespace {

constexpr int kWindow = 31;
constexpr float kNoDesk = std::numeric_limits<float>::quiet_NaN();
constexpr double kWithin_px = 0.6;

/// [px] off the desk's plane; NaN where there is no desk.
Image<float> errors_of(const Points& points, int width, const Plane& desk, const DeviceScale& scale) {
  const bool organised = width > 1 && points.size() > static_cast<std::size_t>(width);
  Image<float> errors(organised ? width : 640, organised ? static_cast<int>(points.size()) / width : 480, kNoDesk);
  const Eigen::Vector3d plane = -desk.normal / desk.offset * scale.focal_px * scale.baseline_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& point = points[i];
    if (!point.allFinite() || !(point.z() > 0.0f)) continue;
    const double error =
        scale.disparity_px(point.z()) - plane.dot(Eigen::Vector3d(point.x() / point.z(), point.y() / point.z(), 1.0));
    if (std::abs(error) > kWithin_px) continue;
    if (organised && i < errors.size()) errors.pixels()[i] = static_cast<float>(error);
    if (organised) continue;
    const Eigen::Vector2d at = scale.pixel_px(point).array().floor();
    if (at.x() >= 0.0 && at.x() < errors.width() && at.y() >= 0.0 && at.y() < errors.height())
      errors(static_cast<int>(at.x()), static_cast<int>(at.y())) = static_cast<float>(error);
  }
  return errors;
}

/// The window without its plane; false where too little of it is desk.
bool take_plane_out(const Image<float>& errors, int left, int top, Image<float>& window) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int y = 0; y < kWindow; ++y)
    for (int x = 0; x < kWindow; ++x) {
      const float error = window(x, y) = errors(left + x, top + y);
      if (std::isnan(error)) continue;
      const Eigen::Vector3d at(x, y, 1.0);
      normal.noalias() += at * at.transpose();
      right += error * at;
    }
  if (normal(2, 2) < 0.9 * kWindow * kWindow) return false;
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  for (int y = 0; y < kWindow; ++y)
    for (int x = 0; x < kWindow; ++x) window(x, y) -= static_cast<float>(plane.dot(Eigen::Vector3d(x, y, 1.0)));
  return true;
}

}  // namespace

void NoiseSums::add(const Points& points, int width, const Plane& desk, const DeviceScale& scale) {
  const Image<float> errors = errors_of(points, width, desk, scale);
  Image<float> window(kWindow, kWindow);
  for (int top = 0; top + kWindow <= errors.height(); top += kWindow)
    for (int left = 0; left + kWindow <= errors.width(); left += kWindow) {
      if (!take_plane_out(errors, left, top, window)) continue;
      for (int y = 0; y < kWindow; ++y)
        for (int x = 0; x < kWindow; ++x) {
          const double here = window(x, y);
          if (std::isnan(here)) continue;
          pixels_ += 1.0, squares_ += here * here;
          for (std::size_t i = 0; i < kNoiseLags_px.size(); ++i) {
            const int lag = kNoiseLags_px[i];
            if (x + lag < kWindow && !std::isnan(window(x + lag, y)))
              row_products_[i] += here * window(x + lag, y), row_pairs_[i] += 1.0;
            if (y + lag < kWindow && !std::isnan(window(x, y + lag)))
              column_products_[i] += here * window(x, y + lag), column_pairs_[i] += 1.0;
          }
        }
    }
}

PixelNoise NoiseSums::noise() const {
  PixelNoise noise;
  if (squares_ <= 0.0) return noise;
  const double variance = squares_ / pixels_;
  noise.sigma_px = std::sqrt(variance);
  for (std::size_t i = 0; i < kNoiseLags_px.size(); ++i) {
    noise.along_rows[i] = row_products_[i] / std::max(row_pairs_[i], 1.0) / variance;
    noise.along_columns[i] = column_products_[i] / std::max(column_pairs_[i], 1.0) / variance;
  }
  return noise;
}

}  // namespace fathom
