#include "sim/sensor/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string>
#include <utility>

#include "core/parallel.h"
#include "core/rng.h"
#include "core/simd.h"
#include "sim/sensor/local_contrast.h"
#include "sim/sensor/speckle.h"

namespace fathom {
namespace {

constexpr int kTaps = 8;  ///< of the interpolation kernel

/// Lanczos kernel of half-width 4 and its derivative.
double lanczos(double t) {
  if (std::fabs(t) < 1e-9) return 1.0;
  if (std::fabs(t) >= 4.0) return 0.0;
  const double a = std::numbers::pi * t;
  return 4.0 * std::sin(a) * std::sin(a / 4.0) / (a * a);
}
double lanczos_slope(double t) {
  constexpr double kStep = 1e-4;
  return (lanczos(t + kStep) - lanczos(t - kStep)) / (2.0 * kStep);
}

/// Weights for the pixels x − 3 … x + 4 that give the value, or the slope per depth pixel, at the infrared pixel
/// x + 2 phase / kPhases.
std::array<float, kTaps> kernel(int phase, double (*law)(double)) {
  std::array<double, kTaps> weights;
  double sum = 0.0;
  for (int tap = 0; tap < kTaps; ++tap) sum += weights[tap] = law(2.0 * phase / kPhases - (tap - 3));
  std::array<float, kTaps> result;
  // Constants stay constant under the value's weights and vanish under the slope's.
  for (int tap = 0; tap < kTaps; ++tap)
    result[tap] = static_cast<float>(law == lanczos ? weights[tap] / sum : 2.0 * (weights[tap] - sum / kTaps));
  return result;
}

FATHOM_SIMD_CLONES
void convolve_row(const float* __restrict source, const std::array<float, kTaps>& weights, float* __restrict even,
                  float* __restrict odd, int pairs) {
  for (int x = 2; x < pairs - 2; ++x) {
    float left = 0.0f, right = 0.0f;
    for (int tap = 0; tap < kTaps; ++tap) {
      left += weights[tap] * source[2 * x + tap - 3];
      right += weights[tap] * source[2 * x + tap - 2];
    }
    even[x] = left, odd[x] = right;
  }
}

SplitColumns<float> convolved(const Image<float>& image, const std::array<float, kTaps>& weights) {
  const int pairs = image.width() / 2;
  SplitColumns<float> result{{pairs + kSlackColumns, image.height()}, {pairs + kSlackColumns, image.height()}};
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) convolve_row(image.row(y), weights, result.even.row(y), result.odd.row(y), pairs);
  });
  return result;
}

FATHOM_SIMD_CLONES
void mean_of_rows(const float* __restrict a, const float* __restrict b, float* __restrict mean, int width) {
  for (int x = 0; x < width; ++x) mean[x] = 0.5f * (a[x] + b[x]);
}

FATHOM_SIMD_CLONES
void split_mean_of_rows(const float* __restrict a, const float* __restrict b, float* __restrict even,
                        float* __restrict odd, int pairs) {
  for (int x = 0; x < pairs; ++x) {
    even[x] = 0.5f * (a[2 * x] + b[2 * x]);
    odd[x] = 0.5f * (a[2 * x + 1] + b[2 * x + 1]);
  }
}

/// Mean of sample(dx, dy) over a grid of `samples_across`² points, dx and dy in 0 … 1 from the pixel's upper left
/// corner.
template <class Sample>
double pixel_mean(int samples_across, Sample sample) {
  double sum = 0.0;
  for (int j = 0; j < samples_across; ++j)
    for (int i = 0; i < samples_across; ++i) sum += sample((i + 0.5) / samples_across, (j + 0.5) / samples_across);
  return sum / (samples_across * samples_across);
}

}  // namespace

int reference_margin(const MatcherModel& matcher) {
  const int reach = std::max(matcher.disparity_max_px, -matcher.disparity_min_px);
  return reach + matcher.window_columns + 8;
}

Image<float> reference_image(const SensorModel& sensor, const Pattern& pattern, int margin_px, int samples_across) {
  constexpr double kBrightness = 500.0;  // [DN]; correlation does not depend on it
  const int scale = static_cast<int>(sensor.ir_scale());
  Image<float> image(sensor.ir_width + 2 * margin_px * scale, sensor.ir_height);
  const double parallax = sensor.baseline / sensor.reference;
  const double blur = blur_steps(sensor, sensor.reference);
  const Image<float> residue = reference_residue(sensor.unit, margin_px, image.width() / scale, image.height() / scale);
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width(); ++x) {
        const double displaced = residue.empty() ? 0.0 : residue(x / scale, y / scale);
        const auto sample = [&](double dx, double dy) {
          const double x_px = (x + dx) / scale - margin_px + displaced, y_px = (y - sensor.ir_first_row() + dy) / scale;
          const Eigen::Vector2d centred(x_px - sensor.principal_px.x(), y_px - sensor.principal_px.y());
          Eigen::Vector2d seen = centred / sensor.focal_px;
          if (sensor.optics.distorts()) seen = sensor.optics.undistorted(seen);
          return pattern.intensity(pattern.on_grid(seen.x() - parallax, seen.y(), sensor.focal_px), blur);
        };
        image(x, y) = static_cast<float>(kBrightness * pixel_mean(samples_across, sample));
      }
  });
  return image;
}

Image<float> rows_in_pairs(const Image<float>& image) {
  Image<float> result(image.width(), image.height() / 2);
  parallel_ranges(result.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      mean_of_rows(image.row(2 * y), image.row(2 * y + 1), result.row(y), image.width());
  });
  return result;
}

Image<float> columns_in_pairs(const Image<float>& image) {
  Image<float> result(image.width() / 2, image.height());
  parallel_ranges(result.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* row = image.row(y);
      for (int x = 0; x < result.width(); ++x) result(x, y) = 0.5f * (row[2 * x] + row[2 * x + 1]);
    }
  });
  return result;
}

SplitColumns<float> split_rows_in_pairs(const Image<float>& image) {
  const int pairs = image.width() / 2, height = image.height() / 2;
  SplitColumns<float> result{{pairs + kSlackColumns, height}, {pairs + kSlackColumns, height}};
  parallel_ranges(height, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      split_mean_of_rows(image.row(2 * y), image.row(2 * y + 1), result.even.row(y), result.odd.row(y), pairs);
  });
  return result;
}

Image<float> mean_of_columns(const SplitColumns<float>& split, int width) {
  Image<float> result(width, split.even.height());
  parallel_ranges(result.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) mean_of_rows(split.even.row(y), split.odd.row(y), result.row(y), width);
  });
  return result;
}

Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px) {
  Reference reference;
  reference.margin_px = margin_px;
  const Image<float> paired = rows_in_pairs(image);
  reference.search = locally_normalised(columns_in_pairs(paired), sensor.matcher, 0);
  constexpr int kOdd = kPhases / 2;  // an odd column lies half a depth pixel to the right
  for (int phase = 0; phase < kOdd; ++phase) {
    auto [even, odd] = convolved(paired, kernel(phase, lanczos));
    reference.value[phase] = std::move(even), reference.value[phase + kOdd] = std::move(odd);
    auto [even_slope, odd_slope] = convolved(paired, kernel(phase, lanczos_slope));
    reference.slope[phase] = std::move(even_slope), reference.slope[phase + kOdd] = std::move(odd_slope);
  }
  if (sensor.matcher.method == MatchMethod::device) reference.blocks = block_reference(sensor.matcher, reference.value);
  return reference;
}

Reference remember(const SensorModel& sensor, const Pattern& pattern, int samples_across) {
  constexpr std::uint64_t kReferenceStream = 0x7265666572ULL;
  const int margin = reference_margin(sensor.matcher);
  Image<float> image = reference_image(sensor, pattern, margin, samples_across);
  add_speckle(speckle_field(sensor, sensor.noise.reference_speckle, image.width(), image.height(),
                            mix_bits(kReferenceStream ^ sensor.unit.serial)),
              image);
  return memorise(sensor, image, margin);
}

std::shared_ptr<const Reference> reference_image(const SensorModel& sensor, const Pattern& pattern,
                                                 int samples_across) {
  struct Kept {
    SensorModel sensor;
    int samples_across = 0;
    std::shared_ptr<const Reference> reference;
  };
  static std::mutex mutex;
  static Kept kept;
  {
    const std::lock_guard lock(mutex);
    if (kept.reference && kept.sensor == sensor && kept.samples_across == samples_across) return kept.reference;
  }
  // Not under the lock: a thread that waits within may take up a task that asks for a reference itself.
  auto made = std::make_shared<const Reference>(remember(sensor, pattern, samples_across));
  const std::lock_guard lock(mutex);
  kept = {sensor, samples_across, made};
  return made;
}

}  // namespace fathom
