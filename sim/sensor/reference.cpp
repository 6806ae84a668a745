#include "sim/sensor/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "core/rng.h"
#include "core/simd.h"
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

/// Weights for the pixels x − 3 … x + 4 that give the value (or the slope) at x + phase / kPhases.
std::array<float, kTaps> kernel(int phase, double (*law)(double)) {
  std::array<double, kTaps> weights;
  double sum = 0.0;
  for (int tap = 0; tap < kTaps; ++tap) sum += weights[tap] = law(static_cast<double>(phase) / kPhases - (tap - 3));
  std::array<float, kTaps> result;
  // Constants stay constant under the value's weights and vanish under the slope's.
  for (int tap = 0; tap < kTaps; ++tap)
    result[tap] = static_cast<float>(law == lanczos ? weights[tap] / sum : weights[tap] - sum / kTaps);
  return result;
}

FATHOM_SIMD_CLONES
void convolve_row(const float* __restrict source, const std::array<float, kTaps>& weights, float* __restrict target,
                  int width) {
  for (int x = 3; x < width - 4; ++x) {
    float sum = 0.0f;
    for (int tap = 0; tap < kTaps; ++tap) sum += weights[tap] * source[x + tap - 3];
    target[x] = sum;
  }
}

Image<float> convolved(const Image<float>& image, const std::array<float, kTaps>& weights) {
  Image<float> result(image.width(), image.height());
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) convolve_row(image.row(y), weights, result.row(y), image.width());
  });
  return result;
}

/// Adds a row to the sums of its columns and of their squares.
FATHOM_SIMD_CLONES
void add_rows(const float* __restrict row, float* __restrict sums, float* __restrict squares, int width) {
  for (int x = 0; x < width; ++x) {
    sums[x] += row[x];
    squares[x] += row[x] * row[x];
  }
}

FATHOM_SIMD_CLONES
void slide_window(const float* __restrict padded_columns, float* __restrict sums, int window, int width) {
  for (int x = 0; x < width; ++x) {
    float sum = 0.0f;
    for (int i = 0; i < window; ++i) sum += padded_columns[x + i];
    sums[x] = sum;
  }
}

FATHOM_SIMD_CLONES
void normalise_row(const float* __restrict row, const float* __restrict sums, const float* __restrict squares,
                   const float* __restrict one_over_count, float least, float scale, float limit,
                   std::int16_t* __restrict result, int width) {
  for (int x = 0; x < width; ++x) {
    const float mean = sums[x] * one_over_count[x];
    const float variance = squares[x] * one_over_count[x] - mean * mean;
    const float deviation = std::sqrt(variance > least * least ? variance : least * least);
    float value = scale * (row[x] - mean) / deviation;
    value = value > limit ? limit : value;
    value = value < -limit ? -limit : value;
    result[x] = static_cast<std::int16_t>(static_cast<int>(value + 64.5f) - 64);
  }
}

FATHOM_SIMD_CLONES
void mean_of_rows(const float* __restrict a, const float* __restrict b, float* __restrict mean, int width) {
  for (int x = 0; x < width; ++x) mean[x] = 0.5f * (a[x] + b[x]);
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
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto sample = [&](double dx, double dy) {
          const double x_px = (x + dx) / scale - margin_px, y_px = (y - sensor.ir_first_row() + dy) / scale;
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

Image<std::int16_t> locally_normalised(const Image<float>& image, const MatcherModel& matcher) {
  const int width = image.width(), columns = matcher.window_columns, rows = matcher.window_rows, half = columns / 2;
  // Largest amplitude for which columns · rows products fit 16 bits; a dot's centre stands about 2.8 deviations out.
  const float limit = std::floor(std::sqrt(32767.0f / static_cast<float>(columns * rows)));
  Image<std::int16_t> result(width, image.height());
  parallel_ranges(image.height(), [&](int begin, int end) {
    std::vector<float> column(width + 2 * half), column_square(width + 2 * half), sum(width), square(width),
        one_over_count(width);
    for (int y = begin; y < end; ++y) {
      const int first = std::max(y - rows / 2, 0), last = std::min(y + rows / 2, image.height() - 1);
      std::fill(column.begin(), column.end(), 0.0f);
      std::fill(column_square.begin(), column_square.end(), 0.0f);
      for (int j = first; j <= last; ++j)
        add_rows(image.row(j), column.data() + half, column_square.data() + half, width);
      slide_window(column.data(), sum.data(), columns, width);
      slide_window(column_square.data(), square.data(), columns, width);
      for (int x = 0; x < width; ++x) {
        const int inside = std::min(x + half, width - 1) - std::max(x - half, 0) + 1;
        one_over_count[x] = 1.0f / static_cast<float>(inside * (last - first + 1));
      }
      normalise_row(image.row(y), sum.data(), square.data(), one_over_count.data(),
                    static_cast<float>(matcher.contrast_min), limit / 2.8f, limit, result.row(y), width);
    }
  });
  return result;
}

Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px) {
  Reference reference;
  reference.margin_px = margin_px;
  const Image<float> paired = rows_in_pairs(image);
  reference.search = locally_normalised(columns_in_pairs(paired), sensor.matcher);
  for (int phase = 0; phase < kPhases; ++phase) {
    reference.shifted.push_back(convolved(paired, kernel(phase, lanczos)));
    reference.gradient.push_back(convolved(paired, kernel(phase, lanczos_slope)));
  }
  if (sensor.matcher.method == MatchMethod::device)
    reference.blocks = block_reference(sensor.matcher, reference.shifted);
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

int refine_first_row(const SensorModel& sensor, int depth_row) {
  return std::clamp(sensor.ir_first_row() / 2 + depth_row - kRefineRows / 2, 0, sensor.ir_height / 2 - kRefineRows);
}

}  // namespace fathom
