#include "sim/sensor/speckle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "core/rng.h"
#include "core/simd.h"
#include "sim/sensor/white_noise.h"

namespace fathom {
namespace {

constexpr std::uint64_t kFieldStream = 0x6669656c64ULL;
constexpr std::uint64_t kRenewalStream = 0x72656e6577ULL;
constexpr int kAcross = 3;       ///< samples of the field along a pixel's side
constexpr int kKernelReach = 4;  ///< of the amplitude's kernel [samples]
constexpr int kKernelTaps = 2 * kKernelReach + 1;

/// Correlation area of the intensity [px²].
double correlation_area(const SensorModel& sensor) {
  const double grain_px = 1e-3 * sensor.wavelength_nm * sensor.optics.f_number / sensor.optics.pixel_um;
  return 4.0 / std::numbers::pi * grain_px * grain_px;
}

/// Weights along one axis that give white noise the amplitude's correlation exp(−π r² / 2S): a Gaussian of half its
/// variance. Their squares sum to 1.
std::array<double, kKernelTaps> amplitude_kernel(const SensorModel& sensor) {
  const double variance = correlation_area(sensor) / (2.0 * std::numbers::pi) * (kAcross * kAcross);  // [samples²]
  std::array<double, kKernelTaps> weights;
  double squares = 0.0;
  for (int tap = 0; tap < kKernelTaps; ++tap) {
    const double off = tap - kKernelReach;
    weights[tap] = std::exp(-0.5 * off * off / variance);
    squares += weights[tap] * weights[tap];
  }
  for (double& weight : weights) weight /= std::sqrt(squares);
  return weights;
}

using Kernel = std::array<float, kKernelTaps>;

FATHOM_SIMD_CLONES
void smooth_along(const float* __restrict white, const Kernel& kernel, float* __restrict smoothed, int samples) {
  for (int i = 0; i < 2 * samples; ++i) {
    float sum = 0.0f;
    for (int tap = 0; tap < kKernelTaps; ++tap) sum += kernel[tap] * white[i + 2 * tap];
    smoothed[i] = sum;
  }
}

FATHOM_SIMD_CLONES
void smooth_across(const std::array<const float*, kKernelTaps>& rows, const Kernel& kernel, float* __restrict sums,
                   int samples) {
  for (int i = 0; i < 2 * samples; ++i) {
    float sum = 0.0f;
    for (int tap = 0; tap < kKernelTaps; ++tap) sum += kernel[tap] * rows[tap][i];
    sums[i] = sum;
  }
}

/// Adds the power of each pixel's samples of a row, times `part`.
void add_power(const float* field, float part, float* __restrict gains, int width) {
  for (int x = 0; x < width; ++x)
    for (int i = 0; i < kAcross; ++i, field += 2) gains[x] += part * (field[0] * field[0] + field[1] * field[1]);
}

}  // namespace

Image<float> speckle_field(const SensorModel& sensor, double coherent_share, int width, int height,
                           std::uint64_t seed) {
  if (coherent_share <= 0.0) return {};
  Kernel kernel;
  const std::array<double, kKernelTaps> exact = amplitude_kernel(sensor);
  for (int tap = 0; tap < kKernelTaps; ++tap) kernel[tap] = static_cast<float>(exact[tap]);
  const auto incoherent = static_cast<float>(1.0 - coherent_share);
  const auto part = static_cast<float>(coherent_share / (kAcross * kAcross));
  Image<float> gains(width, height, incoherent);
  const int samples = kAcross * width;
  constexpr float kUnitPower = 0.25f;  // 1 / √(8 + 8), of real and imaginary parts in turn
  parallel_ranges(height, [&](int begin, int end) {
    std::vector<float> white(2 * (samples + 2 * kKernelReach)), sums(2 * samples);
    std::vector<std::vector<float>> ring(kKernelTaps, std::vector<float>(2 * samples));
    const auto add_row = [&](int row) {
      white_noise(Rng(seed, kFieldStream, static_cast<std::uint64_t>(row)), kUnitPower, white.data(),
                  static_cast<int>(white.size()));
      smooth_along(white.data(), kernel, ring[row % kKernelTaps].data(), samples);
    };
    for (int row = kAcross * begin; row < kAcross * begin + kKernelTaps - 1; ++row) add_row(row);
    for (int y = begin; y < end; ++y)
      for (int row = kAcross * y; row < kAcross * (y + 1); ++row) {
        add_row(row + kKernelTaps - 1);
        std::array<const float*, kKernelTaps> rows;
        for (int tap = 0; tap < kKernelTaps; ++tap) rows[tap] = ring[(row + tap) % kKernelTaps].data();
        smooth_across(rows, kernel, sums.data(), samples);
        add_power(sums.data(), part, gains.row(y), width);
      }
  });
  return gains;
}

double speckle_grains(const SensorModel& sensor) {
  const std::array<double, kKernelTaps> kernel = amplitude_kernel(sensor);
  double along_axis = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      double amplitude = 0.0;  // correlation of the field at samples i and j
      for (int tap = std::abs(i - j); tap < kKernelTaps; ++tap)
        amplitude += kernel[tap] * kernel[tap - std::abs(i - j)];
      along_axis += amplitude * amplitude;
    }
  along_axis /= kAcross * kAcross;
  return 1.0 / (along_axis * along_axis);
}

Image<float> renewed_speckle(const SensorModel& sensor, const Image<float>& field, std::uint64_t seed,
                             std::uint64_t frame) {
  const double renewed = sensor.noise.speckle_renewed, kept = 1.0 - renewed;
  if (renewed == 0.0 || field.empty()) return field;
  const double variance = renewed * (1.0 + kept) * sensor.noise.pixel_speckle / speckle_grains(sensor);
  Image<float> gains(field.width(), field.height());
  parallel_rows(field.height(), [&](int y) {
    for (int x = 0; x < field.width(); ++x) {
      Rng rng(seed, kRenewalStream, frame, static_cast<std::uint64_t>(y) * field.width() + x);
      const double mean = renewed + kept * field(x, y);
      gains(x, y) = static_cast<float>(std::max(mean + std::sqrt(variance * mean) * rng.normal(), 0.0));
    }
  });
  return gains;
}

void add_speckle(const Image<float>& field, Image<float>& image) {
  for (std::size_t i = 0; i < field.size(); ++i) image.pixels()[i] *= field.pixels()[i];
}

}  // namespace fathom
