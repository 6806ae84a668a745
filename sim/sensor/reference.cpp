#include "sim/sensor/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/last_made.h"
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
  parallel_rows(image.height(),
                [&](int y) { convolve_row(image.row(y), weights, result.even.row(y), result.odd.row(y), pairs); });
  return result;
}

/// An image's values, or slopes, at all phases.
std::array<Image<float>, kPhases> at_phases(const Image<float>& paired, double (*law)(double)) {
  constexpr int kOdd = kPhases / 2;  // an odd column lies half a depth pixel to the right
  std::array<Image<float>, kPhases> phases;
  for (int phase = 0; phase < kOdd; ++phase) {
    auto [even, odd] = convolved(paired, kernel(phase, law));
    phases[phase] = std::move(even), phases[phase + kOdd] = std::move(odd);
  }
  return phases;
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

/// What a pixel sees of dots near it: the mean of their light over the middles of the cells of a grid in the pixel.
class PixelOfDots {
 public:
  /// Dots have `sigma_steps` on the grid, a pixel is `pixel_steps` wide there.
  PixelOfDots(const Pattern& pattern, double sigma_steps, double pixel_steps, int samples_across)
      : dots_(pattern.brightness()) {
    for (int i = 0; i <= kTableSize; ++i)
      for (int k = 0; k < samples_across; ++k) {
        const double off = ((k + 0.5) / samples_across - 0.5) * pixel_steps;
        for (int dot = 0; dot < kAcross; ++dot) {
          const double steps = (static_cast<double>(i) / kTableSize + off - (dot - kBefore)) / sigma_steps;
          profile_[i][dot] += static_cast<float>(std::exp(-0.5 * steps * steps) / samples_across);
        }
      }
  }

  /// Around a place on the grid, 0 near its border and outside.
  double operator()(const Eigen::Vector2d& centre) const {
    if (!(centre.x() >= kBefore && centre.y() >= kBefore)) return 0.0;
    const int left = static_cast<int>(centre.x()), top = static_cast<int>(centre.y());
    if (left + kAcross - kBefore > dots_.width() || top + kAcross - kBefore > dots_.height()) return 0.0;
    const Weights &across = weights(centre.x() - left), &down = weights(centre.y() - top);
    Weights sums = Weights::Zero();
    for (int row = 0; row < kAcross; ++row)
      sums += down[row] * Eigen::Map<const Weights>(&dots_(left - kBefore, top - kBefore + row));
    return (across * sums).sum();
  }

 private:
  static constexpr int kAcross = 8, kBefore = 3;  ///< dots that count, and how many of them come before the place
  static constexpr int kTableSize = 1024;         ///< of fractions of a step
  using Weights = Eigen::Array<float, kAcross, 1>;

  const Weights& weights(double fraction) const { return profile_[static_cast<int>(fraction * kTableSize + 0.5)]; }

  const Image<float>& dots_;
  std::vector<Weights> profile_ = std::vector<Weights>(kTableSize + 1, Weights::Zero());
};

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
  const double blur = Defocus(sensor).blur_steps(sensor.reference), sharp = pattern.sigma_steps();
  const double sigma = std::sqrt(sharp * sharp + blur * blur);
  const PixelOfDots pixel(pattern, sigma, 1.0 / (scale * sensor.pattern.step_px), samples_across);
  const double brightness = kBrightness * (sharp / sigma) * (sharp / sigma);  // as much light, spread wider
  const Image<float> residue = reference_residue(sensor.unit, margin_px, image.width() / scale, image.height() / scale);
  parallel_rows(image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      const double displaced = residue.empty() ? 0.0 : residue(x / scale, y / scale);
      const Eigen::Vector2d centre_px((x + 0.5) / scale - margin_px + displaced,
                                      (y - sensor.ir_first_row() + 0.5) / scale);
      Eigen::Vector2d seen = (centre_px - sensor.principal_px) / sensor.focal_px;
      if (sensor.optics.distorts()) seen = sensor.optics.undistorted(seen);
      image(x, y) =
          static_cast<float>(brightness * pixel(pattern.on_grid(seen.x() - parallax, seen.y(), sensor.focal_px)));
    }
  });
  return image;
}

Image<float> rows_in_pairs(const Image<float>& image) {
  Image<float> result(image.width(), image.height() / 2);
  parallel_rows(result.height(),
                [&](int y) { mean_of_rows(image.row(2 * y), image.row(2 * y + 1), result.row(y), image.width()); });
  return result;
}

Image<float> columns_in_pairs(const Image<float>& image) {
  Image<float> result(image.width() / 2, image.height());
  parallel_rows(result.height(), [&](int y) {
    const float* row = image.row(y);
    for (int x = 0; x < result.width(); ++x) result(x, y) = 0.5f * (row[2 * x] + row[2 * x + 1]);
  });
  return result;
}

SplitColumns<float> split_rows_in_pairs(const Image<float>& image) {
  const int pairs = image.width() / 2, height = image.height() / 2;
  SplitColumns<float> result{{pairs + kSlackColumns, height}, {pairs + kSlackColumns, height}};
  parallel_rows(height, [&](int y) {
    split_mean_of_rows(image.row(2 * y), image.row(2 * y + 1), result.even.row(y), result.odd.row(y), pairs);
  });
  return result;
}

Image<float> mean_of_columns(const SplitColumns<float>& split, int width) {
  Image<float> result(width, split.even.height());
  parallel_rows(result.height(),
                [&](int y) { mean_of_rows(split.even.row(y), split.odd.row(y), result.row(y), width); });
  return result;
}

Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px) {
  Reference reference;
  reference.margin_px = margin_px;
  const Image<float> paired = rows_in_pairs(image);
  reference.search = locally_normalised(columns_in_pairs(paired), sensor.matcher, 0);
  std::array<Image<float>, kPhases> value = at_phases(paired, lanczos);
  if (sensor.matcher.method == MatchMethod::device) {
    reference.blocks = block_reference(sensor.matcher, value);
  } else {
    reference.value = std::move(value);
    reference.slope = at_phases(paired, lanczos_slope);
  }
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
  static LastMade<std::pair<SensorModel, int>, Reference> kept;
  return kept.get({sensor, samples_across}, [&] { return remember(sensor, pattern, samples_across); });
}

}  // namespace fathom
