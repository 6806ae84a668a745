#include "bench/desk_noise.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "sim/sensor/depth.h"

namespace fathom {
namespace {

using Codes = Eigen::Matrix<double, kNoiseWindow, kNoiseWindow>;  ///< (row, column)

/// What is left of a window's codes without their least-squares plane.
Codes without_plane(const Codes& codes) {
  constexpr int kMiddle = kNoiseWindow / 2;
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(kNoiseWindow, -kMiddle, kMiddle);
  const double squares = kNoiseWindow * place.square().sum();
  const double across = (codes.colwise().sum().transpose().array() * place).sum() / squares;
  const double down = (codes.rowwise().sum().array() * place).sum() / squares;
  const double mean = codes.mean();
  Codes rest;
  for (int y = 0; y < kNoiseWindow; ++y)
    for (int x = 0; x < kNoiseWindow; ++x) rest(y, x) = codes(y, x) - mean - across * place[x] - down * place[y];
  return rest;
}

double lagged_mean(const Codes& rest, int dx, int dy) {
  const int columns = kNoiseWindow - dx, rows = kNoiseWindow - dy;
  return rest.topLeftCorner(rows, columns).cwiseProduct(rest.bottomRightCorner(rows, columns)).mean();
}

}  // namespace

Image<float> depth_codes(const SensorModel& sensor, const Image<float>& depth) {
  Image<float> codes(depth.width(), depth.height(), std::numeric_limits<float>::quiet_NaN());
  constexpr double kTruncation = 0.0005;  // [m] that cutting to whole millimetres takes away, on average
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (depth.pixels()[i] > 0.0f)
      codes.pixels()[i] = static_cast<float>(device_code(sensor, depth.pixels()[i] + kTruncation));
  return codes;
}

std::vector<DeskWindow> desk_windows(const SensorModel& sensor, const Image<float>& depth, double focal_px,
                                     const Eigen::Vector3d& normal, double offset, double most_off) {
  const Image<float> codes = depth_codes(sensor, depth);
  const auto height = [&](int x, int y) {
    const double z = depth(x, y);
    const Eigen::Vector3d ray((x + 0.5 - 0.5 * depth.width()) / focal_px, (y + 0.5 - 0.5 * depth.height()) / focal_px,
                              1.0);
    return z > 0.0 ? z * normal.dot(ray) - offset : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<DeskWindow> windows;
  for (int top = 0; top + kNoiseWindow <= depth.height(); top += kNoiseWindow)
    for (int left = 0; left + kNoiseWindow <= depth.width(); left += kNoiseWindow) {
      Codes inside;
      double height_sum = 0.0;
      bool desk = true;
      for (int y = 0; y < kNoiseWindow && desk; ++y)
        for (int x = 0; x < kNoiseWindow && desk; ++x) {
          const double off = height(left + x, top + y);
          desk = std::fabs(off) < most_off;
          height_sum += off;
          inside(y, x) = codes(left + x, top + y);
        }
      if (!desk) continue;
      const Codes rest = without_plane(inside);
      DeskWindow window;
      window.left = left, window.top = top;
      window.depth = depth(left + kNoiseWindow / 2, top + kNoiseWindow / 2);
      window.height = height_sum / (kNoiseWindow * kNoiseWindow);
      window.sigma_steps = std::sqrt(rest.squaredNorm() / (kNoiseWindow * kNoiseWindow - 3));
      for (std::size_t i = 0; i < kLagsX.size(); ++i) window.covariance_x[i] = lagged_mean(rest, kLagsX[i], 0);
      for (std::size_t i = 0; i < kLagsY.size(); ++i) window.covariance_y[i] = lagged_mean(rest, 0, kLagsY[i]);
      windows.push_back(window);
    }
  return windows;
}

DeskNoise desk_noise(const SensorModel& sensor, const std::vector<DeskWindow>& windows, double from, double to) {
  DeskNoise noise;
  double variance = 0.0, variance_m2 = 0.0;
  for (const DeskWindow& window : windows) {
    if (window.depth < from || window.depth >= to) continue;
    ++noise.windows;
    const double step = window.depth * window.depth / (8.0 * sensor.focal_px * sensor.baseline);  // [m]
    variance += window.sigma_steps * window.sigma_steps;
    variance_m2 += std::pow(window.sigma_steps * step, 2.0);
    noise.height += window.height;
    for (std::size_t i = 0; i < kLagsX.size(); ++i) noise.correlation_x[i] += window.covariance_x[i];
    for (std::size_t i = 0; i < kLagsY.size(); ++i) noise.correlation_y[i] += window.covariance_y[i];
  }
  if (noise.windows == 0) return noise;
  for (double& covariance : noise.correlation_x) covariance /= variance;
  for (double& covariance : noise.correlation_y) covariance /= variance;
  noise.sigma_steps = std::sqrt(variance / noise.windows);
  noise.sigma = std::sqrt(variance_m2 / noise.windows);
  noise.height /= noise.windows;
  return noise;
}

}  // namespace fathom
