#include "sim/sensor/blurred_pattern.h"

#include <array>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

constexpr int kLevels = 5;

/// Binomial, which is all but a Gaussian.
constexpr std::array kKernel{1.0f / 16.0f, 4.0f / 16.0f, 6.0f / 16.0f, 4.0f / 16.0f, 1.0f / 16.0f};
constexpr double kKernelVariance = 1.0;  ///< [samples²]

/// All is dark outside.
float at(const Image<float>& image, int x, int y) {
  return x >= 0 && y >= 0 && x < image.width() && y < image.height() ? image(x, y) : 0.0f;
}

/// The convolution with the kernel along both axes, every `stride`-th sample of it.
Image<float> smoothed(const Image<float>& image, int stride) {
  Image<float> narrow((image.width() - 1) / stride + 1, image.height());
  for (int y = 0; y < narrow.height(); ++y)
    for (int x = 0; x < narrow.width(); ++x)
      for (int k = 0; k < 5; ++k) narrow(x, y) += kKernel[k] * at(image, stride * x + k - 2, y);
  Image<float> small(narrow.width(), (image.height() - 1) / stride + 1);
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      for (int k = 0; k < 5; ++k) small(x, y) += kKernel[k] * at(narrow, x, stride * y + k - 2);
  return small;
}

}  // namespace

BlurredPattern::BlurredPattern(const Pattern& pattern) : pattern_(pattern) {
  const double dot_variance = pattern.sigma_steps() * pattern.sigma_steps();
  Image<float> values = pattern.brightness();
  for (float& value : values.pixels()) value *= static_cast<float>(2.0 * std::numbers::pi * dot_variance);
  double variance = 0.0, spacing = 1.0;
  for (int level = 0; level < kLevels; ++level) {
    variance += kKernelVariance * spacing * spacing;
    if (level > 0) spacing *= 2.0;
    values = smoothed(values, level > 0 ? 2 : 1);
    levels_.push_back({variance + kLinearVariance * spacing * spacing - dot_variance, spacing, values});
  }
}

double BlurredPattern::intensity(const Eigen::Vector2d& on_grid, double sigma_steps) const {
  const Level* widest = nullptr;
  for (const Level& level : levels_)
    if (level.variance <= sigma_steps * sigma_steps) widest = &level;
  if (!widest) return pattern_.intensity(on_grid);
  const double column = on_grid.x() / widest->spacing, row = on_grid.y() / widest->spacing;
  const Image<float>& values = widest->values;
  if (!(column > -1.0 && row > -1.0 && column < values.width() && row < values.height())) return 0.0;
  const double left = std::floor(column), top = std::floor(row), across = column - left, down = row - top;
  const int x = static_cast<int>(left), y = static_cast<int>(top);
  return (1.0 - down) * ((1.0 - across) * at(values, x, y) + across * at(values, x + 1, y)) +
         down * ((1.0 - across) * at(values, x, y + 1) + across * at(values, x + 1, y + 1));
}

double blur_steps(const Rig& rig, const ReturnedLight& light) {
  constexpr double kPart = 0.25;
  return kPart * light.spread * rig.sensor.focal_px / rig.sensor.pattern.step_px;
}

double intensity_around(const BlurredPattern& pattern, const Rig& rig, const ReturnedLight& light) {
  const std::optional<Eigen::Vector2d> at = on_grid(pattern.sharp(), rig, light.direction);
  return at ? pattern.intensity(*at, blur_steps(rig, light)) : 0.0;
}

}  // namespace fathom
