#include "sim/sensor/disparity_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "core/rng.h"
#include "core/simd.h"
#include "sim/sensor/add_scaled.h"
#include "sim/sensor/pattern.h"
#include "sim/sensor/white_noise.h"

namespace fathom {
namespace {

constexpr std::uint64_t kBlockStream = 0x626c6f636bULL;

/// sum[x] += Σ n[x + i], moment[x] += Σ (i − half) n[x + i] over `count` places.
FATHOM_SIMD_CLONES
void sum_along(const float* __restrict noise, int count, float* __restrict sum, float* __restrict moment, int width) {
  std::fill_n(sum, width, 0.0f);
  std::fill_n(moment, width, 0.0f);
  for (int i = 0; i < count; ++i) {
    const auto off = static_cast<float>(i - count / 2);
    for (int x = 0; x < width; ++x) sum[x] += noise[x + i], moment[x] += off * noise[x + i];
  }
}

/// Σ i² over a window of `count` places about its middle.
double second_moment(int count) { return count * (static_cast<double>(count) * count - 1.0) / 12.0; }

/// How uncertain a block's disparity is, from the variance v [px²] of its dots and the brightness c [DN] of their
/// centres; k, r and s are constants of the sensor.
/// Contrast [DN] is the standard deviation of Gaussian spots that lie at random: c √(k / v), by Campbell's theorem.
/// Speckle's error is proportional to the light, and looks like a shift of that error over the light's gradient. With
/// the dots' width the light's root mean square falls, and its gradient with the width's square: the shift's variance
/// goes with v.
/// The detector's error has the variance s c + r, of shot and read noise. Because the mean squared slope is
/// contrast² / 2 v, the shift's variance is proportional to (s c + r) v² / c².
class BlockLaw {
 public:
  explicit BlockLaw(const SensorModel& sensor) : defocus_(sensor), step_px_(sensor.pattern.step_px) {
    sharp_ = std::pow(sensor.pattern.dot_sigma_ir_px / sensor.ir_scale(), 2.0);
    const double per_px2 =
        sensor.pattern.dots_per_tile / (sensor.pattern.tile_columns * sensor.pattern.tile_rows * step_px_ * step_px_);
    const double light = 2.0 * std::numbers::pi * sharp_;  // of one dot, over its centre's brightness in focus [px²]
    contrast2_ = light * light * per_px2 / (4.0 * std::numbers::pi);
    speckle_ = std::pow(sensor.noise.disparity.facing_px, 2.0) / variance(1.0 / sensor.law.far);
    const double pixels = std::pow(sensor.ir_scale(), 2.0) * sensor.matcher.window_columns * sensor.matcher.window_rows;
    if (sensor.noise.electrons_per_dn > 0.0)
      shot_ = 2.0 / (pixels * contrast2_) * light * per_px2 * sensor.noise.gain / sensor.noise.electrons_per_dn;
    read_ = 2.0 / (pixels * contrast2_) * sensor.noise.read_dn * sensor.noise.read_dn;
  }

  /// Of a dot's width, defocus included [px²].
  double variance(double dioptres) const { return sharp_ + step_px_ * step_px_ * defocus_.blur2_steps(dioptres); }
  double contrast2(double centre_dn, double variance) const { return centre_dn * centre_dn * contrast2_ / variance; }
  double speckle_px2(double variance) const { return speckle_ * variance; }
  double detector_px2(double centre_dn, double variance) const {
    return (shot_ * centre_dn + read_) * variance * variance / (centre_dn * centre_dn);
  }

 private:
  Defocus defocus_;
  double step_px_, sharp_ = 0.0, contrast2_ = 0.0, speckle_ = 0.0, shot_ = 0.0, read_ = 0.0;
};

/// The disparity at a place in the image, between the pixels of one surface; across an edge the nearest pixel's.
float disparity_at(const Image<float>& exact, float x, float y) {
  constexpr float kSameSurface = 1.0f;  // [px]
  const int i = std::clamp(static_cast<int>(x), 0, exact.width() - 2);
  const int j = std::clamp(static_cast<int>(y), 0, exact.height() - 2);
  const float across = std::clamp(x - static_cast<float>(i), 0.0f, 1.0f);
  const float down = std::clamp(y - static_cast<float>(j), 0.0f, 1.0f);
  const float *upper = exact.row(j) + i, *lower = exact.row(j + 1) + i;
  const auto [least, most] = std::minmax({upper[0], upper[1], lower[0], lower[1]});
  if (least <= 0.0f || most - least > kSameSurface) return (down < 0.5f ? upper : lower)[across < 0.5f ? 0 : 1];
  return (1.0f - down) * ((1.0f - across) * upper[0] + across * upper[1]) +
         down * ((1.0f - across) * lower[0] + across * lower[1]);
}

/// Adds to a row of disparities [px] what is drawn once for a scene and what each frame draws anew; 0 where blocks have
/// too little contrast.
FATHOM_SIMD_CLONES
void add_noise(const SensorModel& sensor, const BlockLaw& law, const float* __restrict intensity,
               const float* __restrict still, const float* __restrict renewed, float* __restrict disparity, int width) {
  const double dioptres_per_px = 1.0 / (sensor.focal_px * sensor.baseline), gain = sensor.noise.gain;
  const double of_renewed = sensor.noise.disparity.renewed;
  const double least2 = sensor.matcher.contrast_min * sensor.matcher.contrast_min;
  for (int x = 0; x < width; ++x) {
    const double exact = disparity[x], centre_dn = gain * intensity[x];
    const double variance = law.variance(dioptres_per_px * exact);
    const double speckle = law.speckle_px2(variance), detector = law.detector_px2(centre_dn, variance);
    const double noisy = exact + std::sqrt((1.0 - of_renewed) * speckle) * still[x] +
                         std::sqrt(of_renewed * speckle + detector) * renewed[x];
    const bool is_matched = exact > 0.0 && law.contrast2(centre_dn, variance) >= least2 && noisy > 0.0;
    disparity[x] = is_matched ? static_cast<float>(noisy) : 0.0f;
  }
}

}  // namespace

BlockChance block_chance(const SensorModel& sensor, std::uint64_t seed, std::uint64_t key) {
  const int width = sensor.width, height = sensor.height;
  const int columns = sensor.matcher.window_columns, rows = sensor.matcher.window_rows;
  Image<float> sums(width, height + rows - 1), moments(width, height + rows - 1);
  const float per_deviation = 1.0f / std::sqrt(8.0f);  // adding up blocks makes it normal
  parallel_ranges(sums.height(), [&](int begin, int end) {
    std::vector<float> noise(width + columns - 1);
    for (int y = begin; y < end; ++y) {
      white_noise(Rng(seed, kBlockStream, key, static_cast<std::uint64_t>(y)), per_deviation, noise.data(),
                  static_cast<int>(noise.size()));
      sum_along(noise.data(), columns, sums.row(y), moments.row(y), width);
    }
  });
  BlockChance chance{Image<float>(width, height), Image<float>(width, height), Image<float>(width, height)};
  const auto per_level = static_cast<float>(1.0 / std::sqrt(columns * rows));
  // Light cannot lie elsewhere in a block of one pixel.
  const auto per_moment = [](double moment) {
    return static_cast<float>(moment > 0.0 ? 1.0 / std::sqrt(moment) : 0.0);
  };
  const float per_across = per_moment(second_moment(columns) * rows),
              per_down = per_moment(columns * second_moment(rows));
  parallel_rows(height, [&](int y) {
    for (int j = 0; j < rows; ++j) {
      add_scaled(sums.row(y + j), per_level, chance.level.row(y), width);
      add_scaled(moments.row(y + j), per_across, chance.across.row(y), width);
      add_scaled(sums.row(y + j), per_down * static_cast<float>(j - rows / 2), chance.down.row(y), width);
    }
  });
  return chance;
}

double block_contrast(const SensorModel& sensor, double intensity, double depth) {
  const BlockLaw law(sensor);
  return std::sqrt(law.contrast2(intensity * sensor.noise.gain, law.variance(1.0 / depth)));
}

Image<float> disparity_with_noise(const SensorModel& sensor, const Image<float>& exact_px,
                                  const Image<float>& intensity, const BlockChance& still, const BlockChance& renewed) {
  const DisparityNoise& noise = sensor.noise.disparity;
  const BlockLaw law(sensor);
  const auto still_off = static_cast<float>(noise.lateral_px * std::sqrt(1.0 - noise.renewed));
  const auto renewed_off = static_cast<float>(noise.lateral_px * std::sqrt(noise.renewed));
  const int border = sensor.matcher.window_columns / 2, width = exact_px.width() - 2 * border;
  Image<float> noisy(exact_px.width(), exact_px.height());
  if (width <= 0) return noisy;
  parallel_rows(noisy.height(), [&](int y) {
    for (int x = border; x < border + width; ++x)
      noisy(x, y) = disparity_at(
          exact_px, static_cast<float>(x) + still_off * still.across(x, y) + renewed_off * renewed.across(x, y),
          static_cast<float>(y) + still_off * still.down(x, y) + renewed_off * renewed.down(x, y));
    add_noise(sensor, law, intensity.row(y) + border, still.level.row(y) + border, renewed.level.row(y) + border,
              noisy.row(y) + border, width);
  });
  return noisy;
}

}  // namespace fathom
