#include "bench/desk_rows.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "bench/desk_noise.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr double kMostOff = 0.015;  // [m] above or below the desk: five deviations at the far end
constexpr int kFewestWindows = 5;
constexpr std::array kBands{0.58, 0.72, 0.85, 1.00, 1.20};  // [m] borders

/// Mean cosines of disparities in steps and of depths in millimetres, of the desk within a band.
struct Combs {
  double steps = 0.0, millimetres = 0.0;
};
Combs combs(const SensorModel& sensor, const DeskImage& image, double from, double to) {
  constexpr double kHalfCut_mm = 0.5;
  const double per_inverse_mm = 8.0 * sensor.focal_px * mm_from_metres(sensor.baseline);
  Combs sum;
  int count = 0;
  for (int y = 0; y < image.depth.height(); ++y)
    for (int x = 0; x < image.depth.width(); ++x) {
      const float z = image.depth(x, y);
      if (z < from || z >= to) continue;
      if (std::abs(image.desk.normal.dot(point_in_colour(image.depth, x, y)) + image.desk.offset) > kMostOff) continue;
      const double z_mm = mm_from_metres(z);
      const double steps = per_inverse_mm * (1.0 / mm_from_metres(sensor.reference) - 1.0 / (z_mm + kHalfCut_mm)) - 0.5;
      sum.steps += std::cos(2.0 * std::numbers::pi * steps);
      sum.millimetres += std::cos(2.0 * std::numbers::pi * z_mm);
      ++count;
    }
  return {sum.steps / count, sum.millimetres / count};
}

/// Of every place where something stands before the desk, how long a baseline would make its shadow [mm]: the sum of
/// those that lie to the left of the things over the sum of all; nothing when there are none.
std::optional<double> shadow_share(const Image<float>& depth) {
  constexpr double kLeastStep = 0.03, kWidest_mm = 150.0;  // [m]; wider ones are no shadows
  double left_mm = 0.0, right_mm = 0.0;
  for (int y = 0; y < depth.height(); ++y) {
    int last = -1;
    for (int x = 0; x < depth.width(); ++x) {
      const double z = depth(x, y);
      if (z <= 0.0) continue;
      const double before = last >= 0 ? depth(last, y) : z;
      if (std::abs(z - before) > kLeastStep) {
        const double mm = mm_from_metres((x - last - 1) / kColourFocalPx / std::abs(1.0 / z - 1.0 / before));
        if (mm < kWidest_mm) (z < before ? left_mm : right_mm) += mm;
      }
      last = x;
    }
  }
  if (left_mm + right_mm <= 0.0) return std::nullopt;
  return left_mm / (left_mm + right_mm);
}

/// Of the heights of windows side by side within a band [m]: root mean square of what they differ by, over √2, so that
/// it is their deviation where nothing is shared; nothing of fewer than five pairs.
std::optional<double> rough_bias(const std::vector<DeskWindow>& windows, double from, double to) {
  const auto is_in = [&](const DeskWindow& window) { return window.depth >= from && window.depth < to; };
  double squares = 0.0;
  int pairs = 0;
  for (std::size_t i = 1; i < windows.size(); ++i) {
    const DeskWindow &left = windows[i - 1], &right = windows[i];
    if (!is_in(left) || !is_in(right) || left.top != right.top || left.left + kNoiseWindow != right.left) continue;
    squares += 0.5 * std::pow(right.height - left.height, 2.0);
    ++pairs;
  }
  if (pairs < kFewestWindows) return std::nullopt;
  return std::sqrt(squares / pairs);
}

}  // namespace

std::vector<DeskRow> desk_rows(const SensorModel& sensor, const DeskImage& image) {
  std::vector<DeskRow> rows;
  const std::vector<DeskWindow> windows =
      desk_windows(sensor, image.depth, kColourFocalPx, image.desk.normal, -image.desk.offset, kMostOff);
  for (std::size_t band = 0; band + 1 < kBands.size(); ++band) {
    const double from = kBands[band], to = kBands[band + 1], middle_mm = mm_from_metres(0.5 * (from + to));
    const DeskNoise noise = desk_noise(sensor, windows, from, to);
    if (noise.windows < kFewestWindows) continue;
    double squares = 0.0;
    for (const DeskWindow& window : windows)
      if (window.depth >= from && window.depth < to) squares += window.height * window.height;
    const Combs comb = combs(sensor, image, from, to);
    rows.push_back({"sigma_steps", "desk", middle_mm, noise.sigma_steps});
    for (std::size_t i = 0; i < kLagsX.size(); ++i)
      rows.push_back({"correlation", fmt::format("x {}", kLagsX[i]), middle_mm, noise.correlation_x[i]});
    for (std::size_t i = 0; i < kLagsY.size(); ++i)
      rows.push_back({"correlation", fmt::format("y {}", kLagsY[i]), middle_mm, noise.correlation_y[i]});
    rows.push_back({"slow_bias_mm", "desk", middle_mm, mm_from_metres(std::sqrt(squares / noise.windows))});
    if (const auto rough = rough_bias(windows, from, to))
      rows.push_back({"rough_bias_mm", "desk", middle_mm, mm_from_metres(*rough)});
    rows.push_back({"comb_strength", "desk", middle_mm, comb.steps});
    rows.push_back({"millimetre_comb", "desk", middle_mm, comb.millimetres});
  }
  if (const auto share = shadow_share(image.depth)) rows.push_back({"shadow_share", "left", 0.0, *share});
  return rows;
}

}  // namespace fathom
