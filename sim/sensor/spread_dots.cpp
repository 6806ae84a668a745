#include "sim/sensor/spread_dots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/sensor/add_scaled.h"

namespace fathom {
namespace {

/// Samples per step of the sharpest layer; a dot's image has a standard deviation of about two of them.
constexpr int kSamplesPerStep = 4;

/// Light that left its straight way by more than this many steps of its layer's pattern goes to a wider one.
constexpr double kFarSteps = 12.0;

/// A function of the place [samples], on the integers of a rectangle.
struct Spot {
  int left, top;
  Image<float> values;

  int right() const { return left + values.width(); }
  int bottom() const { return top + values.height(); }

  /// Shared out linearly among the four places around it.
  void add(double x, double y, double weight) {
    const double column = std::floor(x), row = std::floor(y);
    const auto across = static_cast<float>(x - column), down = static_cast<float>(y - row);
    const int i = static_cast<int>(column) - left, j = static_cast<int>(row) - top;
    const auto w = static_cast<float>(weight);
    values(i, j) += w * (1.0f - across) * (1.0f - down), values(i + 1, j) += w * across * (1.0f - down);
    values(i, j + 1) += w * (1.0f - across) * down, values(i + 1, j + 1) += w * across * down;
  }
};

/// `weights[k]` at distance k from the middle, in both directions; the spot has that much room at its border.
void blur(std::span<const float> weights, Spot& spot) {
  const int reach = static_cast<int>(weights.size()) - 1, width = spot.values.width(), height = spot.values.height();
  Image<float> across(width, height), both(width, height);
  for (int y = 0; y < height; ++y)
    for (int k = -reach; k <= reach; ++k) {
      const int skipped = std::max(k, 0), count = width - std::abs(k);
      add_scaled(spot.values.row(y) + std::max(-k, 0), weights[std::abs(k)], across.row(y) + skipped, count);
    }
  for (int y = 0; y < height; ++y)
    for (int k = -reach; k <= reach; ++k)
      if (y + k >= 0 && y + k < height) add_scaled(across.row(y + k), weights[std::abs(k)], both.row(y), width);
  spot.values = std::move(both);
}

/// Weights at 0, 1, 2 … samples from the middle of a Gaussian of this variance [samples²]. Along both axes together
/// they sum to `area`, which is 2π times the variance where the middle is to be 1.
std::vector<float> gaussian(double variance, double area) {
  constexpr double kDeviations = 3.7;  // a thousandth is left
  std::vector<float> weights(static_cast<std::size_t>(std::ceil(kDeviations * std::sqrt(variance))) + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k)
    sum += (k == 0 ? 1.0 : 2.0) *
           (weights[k] = static_cast<float>(std::exp(-0.5 * static_cast<double>(k * k) / variance)));
  for (float& weight : weights) weight *= static_cast<float>(std::sqrt(area) / sum);
  return weights;
}

/// Σ over `dots` of their brightness times `spot` about their places, `per_dot` samples apart, into `values`, whose
/// first sample lies at (left, top).
void add_spots(const Image<float>& dots, int per_dot, const Spot& spot, int left, int top, Image<float>& values) {
  const auto below = [](int a, int b) { return static_cast<int>(std::floor(static_cast<double>(a) / b)); };
  const int right = left + values.width(), bottom = top + values.height();
  const int first_column = std::max(below(left - spot.right(), per_dot), 0);
  const int last_column = std::min(below(right - spot.left, per_dot) + 1, dots.width());
  const int first_row = std::max(below(top - spot.bottom(), per_dot), 0);
  const int last_row = std::min(below(bottom - spot.top, per_dot) + 1, dots.height());
  for (int row = first_row; row < last_row; ++row)
    for (int column = first_column; column < last_column; ++column) {
      const float brightness = dots(column, row);
      if (brightness == 0.0f) continue;
      const int x = per_dot * column, y = per_dot * row;
      const int begin = std::max(left, x + spot.left), end = std::min(right, x + spot.right());
      if (begin >= end) continue;
      for (int j = std::max(top, y + spot.top); j < std::min(bottom, y + spot.bottom()); ++j)
        add_scaled(spot.values.row(j - y - spot.top) + begin - x - spot.left, brightness,
                   values.row(j - top) + begin - left, end - begin);
    }
}

}  // namespace

SpreadDots::SpreadDots(const BlurredPattern& pattern, std::span<const SpreadLight> lights, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high) {
  const std::span<const BlurredPattern::Level> levels = pattern.levels();
  const Pattern& sharp = pattern.sharp();
  const double farthest = sharp.columns() + sharp.rows();
  // Layer 0 is of sharp dots, layer n of level n − 1 of the pyramid. What light is shared out to and what is read
  // between samples blur it a little more; at a dot's own width this is taken off.
  const std::size_t count = levels.size() + 1;
  const auto spacing_of = [&](std::size_t layer) { return layer == 0 ? 1.0 : levels[layer - 1].spacing; };
  const auto layer_of = [&](const SpreadLight& light) {
    const double off = std::max(std::fabs(light.dx_steps), std::fabs(light.dy_steps));
    std::size_t layer = 0;
    while (layer + 1 < count) {
      const BlurredPattern::Level& next = levels[layer];
      const double variance = next.variance + kLinearVariance * next.spacing * next.spacing;
      if (variance > static_cast<double>(light.blur_steps) * light.blur_steps && off <= kFarSteps * spacing_of(layer))
        break;
      ++layer;
    }
    return layer;
  };
  std::vector<std::vector<const SpreadLight*>> of_layer(count);
  for (const SpreadLight& light : lights)
    if (std::max(std::fabs(light.dx_steps), std::fabs(light.dy_steps)) < farthest)
      of_layer[layer_of(light)].push_back(&light);

  for (std::size_t n = 0; n < count; ++n) {
    if (of_layer[n].empty()) continue;
    const int per_dot = n == 0 ? kSamplesPerStep : 1;
    Layer layer{spacing_of(n) / per_dot};
    std::vector<float> dot{1.0f};
    if (n == 0) {
      const double variance = std::pow(sharp.sigma_steps() / layer.spacing, 2.0);
      dot = gaussian(std::max(variance - 2.0 * kLinearVariance, 0.25 * variance), 2.0 * std::numbers::pi * variance);
    }
    const int room = static_cast<int>(dot.size());
    int reach = 0;
    for (const SpreadLight* light : of_layer[n])
      reach = std::max(reach, 1 + static_cast<int>(std::max(std::fabs(light->dx_steps), std::fabs(light->dy_steps)) /
                                                   layer.spacing));
    reach += room;
    Spot spot{-reach, -reach, Image<float>(2 * reach + 1, 2 * reach + 1)};
    for (const SpreadLight* light : of_layer[n])
      spot.add(-light->dx_steps / layer.spacing, -light->dy_steps / layer.spacing, light->dn);
    if (n == 0) blur(dot, spot);

    layer.left = static_cast<int>(std::floor(low.x() / layer.spacing));
    layer.top = static_cast<int>(std::floor(low.y() / layer.spacing));
    layer.values = Image<float>(static_cast<int>(std::floor(high.x() / layer.spacing)) + 2 - layer.left,
                                static_cast<int>(std::floor(high.y() / layer.spacing)) + 2 - layer.top);
    add_spots(n == 0 ? sharp.brightness() : levels[n - 1].values, per_dot, spot, layer.left, layer.top, layer.values);
    layers_.push_back(std::move(layer));
  }
}

double SpreadDots::operator()(const Eigen::Vector2d& way) const {
  double sum = 0.0;
  for (const Layer& layer : layers_) {
    const double x = std::clamp(way.x() / layer.spacing - layer.left, 0.0, layer.values.width() - 1.001);
    const double y = std::clamp(way.y() / layer.spacing - layer.top, 0.0, layer.values.height() - 1.001);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float *upper = layer.values.row(j) + i, *lower = layer.values.row(j + 1) + i;
    sum += std::lerp(std::lerp(static_cast<double>(upper[0]), upper[1], x - i),
                     std::lerp(static_cast<double>(lower[0]), lower[1], x - i), y - j);
  }
  return sum;
}

}  // namespace fathom
