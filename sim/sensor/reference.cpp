#include "sim/sensor/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "core/simd.h"

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
void convolve_row(const float* __restrict source, const std::array<float, kTaps>& weights, float* __restrict target, int width) {
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

/// Sums over the rows of the window that starts at `first_row`: one value per column and moment.
struct ColumnSums {
  std::vector<double> r, g, rr, rg, gg, gg_y;
};

void sum_columns(const Image<float>& shifted, const Image<float>& gradient, int first_row, ColumnSums& sums) {
  const int width = shifted.width();
  for (auto* moment : {&sums.r, &sums.g, &sums.rr, &sums.rg, &sums.gg, &sums.gg_y}) moment->assign(width, 0.0);
  for (int j = 0; j < kRefineWindow; ++j) {
    const float *r = shifted.row(first_row + j), *g = gradient.row(first_row + j);
    for (int x = 0; x < width; ++x) {
      sums.r[x] += r[x];
      sums.g[x] += g[x];
      sums.rr[x] += r[x] * r[x];
      sums.rg[x] += r[x] * g[x];
      sums.gg[x] += g[x] * g[x];
      sums.gg_y[x] += g[x] * g[x] * static_cast<float>(j);
    }
  }
}

WindowMoments sum_window(const ColumnSums& sums, int first_column) {
  double r = 0, g = 0, rr = 0, rg = 0, gg = 0, gg_x = 0, gg_y = 0;
  for (int i = 0; i < kRefineWindow; ++i) {
    const int x = first_column + i;
    r += sums.r[x], g += sums.g[x], rr += sums.rr[x], rg += sums.rg[x], gg += sums.gg[x];
    gg_x += sums.gg[x] * i, gg_y += sums.gg_y[x];
  }
  const double middle = 0.5 * (kRefineWindow - 1);
  return {static_cast<float>(r),  static_cast<float>(g),  static_cast<float>(rr),
          static_cast<float>(rg), static_cast<float>(gg), static_cast<float>(gg > 0 ? gg_x / gg : middle),
          static_cast<float>(gg > 0 ? gg_y / gg : middle)};
}

/// Mean over a columns×rows window around every pixel, cut at the image's edge.
Image<float> window_mean(const Image<float>& image, int columns, int rows) {
  Image<float> across(image.width(), image.height()), result(image.width(), image.height());
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* source = image.row(y);
      for (int x = 0; x < image.width(); ++x) {
        const int first = std::max(x - columns / 2, 0), last = std::min(x + columns / 2, image.width() - 1);
        float sum = 0.0f;
        for (int i = first; i <= last; ++i) sum += source[i];
        across(x, y) = sum / static_cast<float>(last - first + 1);
      }
    }
  });
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const int first = std::max(y - rows / 2, 0), last = std::min(y + rows / 2, image.height() - 1);
      float* target = result.row(y);
      for (int j = first; j <= last; ++j) {
        const float* source = across.row(j);
        for (int x = 0; x < image.width(); ++x) target[x] += source[x];
      }
      for (int x = 0; x < image.width(); ++x) target[x] /= static_cast<float>(last - first + 1);
    }
  });
  return result;
}

}  // namespace

int reference_margin(const MatcherModel& matcher) {
  const int reach = std::max(matcher.disparity_max_px, -matcher.disparity_min_px);
  return reach + std::max(matcher.window_columns / 2, kRefineWindow / 2) + 4;
}

Image<float> reference_image(const SensorModel& sensor, const Pattern& pattern, int margin_px, int samples_across) {
  constexpr double kBrightness = 500.0;  // [DN]; correlation does not depend on it
  const int scale = static_cast<int>(sensor.ir_scale());
  Image<float> image(sensor.ir_width + 2 * margin_px * scale, sensor.ir_height);
  const double parallax = sensor.baseline / sensor.reference;
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width(); ++x) {
        double sum = 0.0;
        for (int j = 0; j < samples_across; ++j)
          for (int i = 0; i < samples_across; ++i) {
            const double x_px = (x + (i + 0.5) / samples_across) / scale - margin_px;
            const double y_px = (y - sensor.ir_first_row() + (j + 0.5) / samples_across) / scale;
            sum += pattern.intensity((x_px - sensor.principal_px.x()) / sensor.focal_px - parallax,
                                     (y_px - sensor.principal_px.y()) / sensor.focal_px, sensor.focal_px);
          }
        image(x, y) = static_cast<float>(kBrightness * sum / (samples_across * samples_across));
      }
  });
  return image;
}

Image<float> halved(const Image<float>& image) {
  Image<float> half(image.width() / 2, image.height() / 2);
  parallel_ranges(half.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float *a = image.row(2 * y), *b = image.row(2 * y + 1);
      for (int x = 0; x < half.width(); ++x)
        half(x, y) = 0.25f * (a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1]);
    }
  });
  return half;
}

Image<std::int16_t> locally_normalised(const Image<float>& image, const MatcherModel& matcher) {
  const int columns = matcher.window_columns, rows = matcher.window_rows;
  // Largest amplitude for which columns · rows products fit 16 bits; a dot's centre stands about 2.8 deviations out.
  const float limit = std::floor(std::sqrt(32767.0f / static_cast<float>(columns * rows)));
  const float scale = limit / 2.8f;
  const Image<float> mean = window_mean(image, columns, rows);
  Image<float> squared(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) squared.pixels()[i] = image.pixels()[i] * image.pixels()[i];
  const Image<float> mean_square = window_mean(squared, columns, rows);
  Image<std::int16_t> result(image.width(), image.height());
  const float least = static_cast<float>(matcher.contrast_min);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const float m = mean.pixels()[i];
    const float deviation = std::sqrt(std::max(mean_square.pixels()[i] - m * m, 0.0f));
    const float value = scale * (image.pixels()[i] - m) / std::max(deviation, least);
    result.pixels()[i] = static_cast<std::int16_t>(std::lrint(std::clamp(value, -limit, limit)));
  }
  return result;
}

Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px) {
  Reference reference;
  reference.margin_px = margin_px;
  reference.search = locally_normalised(halved(image), sensor.matcher);
  for (int phase = 0; phase < kPhases; ++phase) {
    reference.shifted.push_back(convolved(image, kernel(phase, lanczos)));
    reference.gradient.push_back(convolved(image, kernel(phase, lanczos_slope)));
  }
  reference.moment_columns = image.width() - kRefineWindow + 1;
  reference.moments.resize(static_cast<std::size_t>(sensor.height) * reference.moment_columns * kPhases);
  parallel_ranges(sensor.height, [&](int begin, int end) {
    ColumnSums sums;
    for (int row = begin; row < end; ++row)
      for (int phase = 0; phase < kPhases; ++phase) {
        sum_columns(reference.shifted[phase], reference.gradient[phase], window_first_row(sensor, row), sums);
        for (int x = 0; x < reference.moment_columns; ++x)
          reference.moments[(static_cast<std::size_t>(row) * reference.moment_columns + x) * kPhases + phase] = sum_window(sums, x);
      }
  });
  return reference;
}

}  // namespace fathom
