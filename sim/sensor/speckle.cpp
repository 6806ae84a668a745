#include "sim/sensor/speckle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "core/rng.h"

namespace fathom {
namespace {

constexpr std::uint64_t kFieldStream = 0x6669656c64ULL;
constexpr std::uint64_t kRenewalStream = 0x72656e6577ULL;
constexpr int kAcross = 3;  ///< samples of the field along a pixel's side
constexpr int kReach = 4;   ///< of the amplitude's kernel [samples]
constexpr int kTaps = 2 * kReach + 1;

/// Correlation area of the intensity [px²].
double correlation_area(const SensorModel& sensor) {
  const double grain_px = 1e-3 * sensor.wavelength_nm * sensor.optics.f_number / sensor.optics.pixel_um;
  return 4.0 / std::numbers::pi * grain_px * grain_px;
}

/// Weights along one axis that give white noise the amplitude's correlation exp(−π r² / 2S): a Gaussian of half its
/// variance. Their squares sum to 1.
std::array<double, kTaps> amplitude_kernel(const SensorModel& sensor) {
  const double variance = correlation_area(sensor) / (2.0 * std::numbers::pi) * (kAcross * kAcross);  // [samples²]
  std::array<double, kTaps> weights;
  double squares = 0.0;
  for (int tap = 0; tap < kTaps; ++tap) {
    const double off = tap - kReach;
    weights[tap] = std::exp(-0.5 * off * off / variance);
    squares += weights[tap] * weights[tap];
  }
  for (double& weight : weights) weight /= std::sqrt(squares);
  return weights;
}

using Amplitude = std::complex<float>;

/// White complex noise of unit power, smoothed along one row of samples.
void smoothed_row(std::uint64_t seed, int row, const std::array<float, kTaps>& kernel, std::vector<Amplitude>& white,
                  std::vector<Amplitude>& smoothed) {
  // The number of ones among 32 random bits is all but normal, with variance 8, and cheap; smoothing does the rest.
  constexpr float kUnit = 0.25f;  // 1 / √(8 + 8)
  Rng rng(seed, kFieldStream, static_cast<std::uint64_t>(row));
  for (Amplitude& sample : white) {
    const std::uint64_t bits = rng.bits();
    sample = {kUnit * static_cast<float>(std::popcount(bits >> 32) - 16),
              kUnit * static_cast<float>(std::popcount(bits & 0xffffffffULL) - 16)};
  }
  for (std::size_t x = 0; x < smoothed.size(); ++x) {
    Amplitude sum = 0.0f;
    for (int tap = 0; tap < kTaps; ++tap) sum += kernel[tap] * white[x + tap];
    smoothed[x] = sum;
  }
}

}  // namespace

Image<float> speckle_field(const SensorModel& sensor, double coherent_share, int width, int height,
                           std::uint64_t seed) {
  if (coherent_share <= 0.0) return {};
  std::array<float, kTaps> kernel;
  const std::array<double, kTaps> exact = amplitude_kernel(sensor);
  for (int tap = 0; tap < kTaps; ++tap) kernel[tap] = static_cast<float>(exact[tap]);
  const auto incoherent = static_cast<float>(1.0 - coherent_share);
  const auto part = static_cast<float>(coherent_share / (kAcross * kAcross));
  Image<float> gains(width, height, incoherent);
  const std::size_t samples = static_cast<std::size_t>(kAcross) * width;
  parallel_ranges(height, [&](int begin, int end) {
    std::vector<Amplitude> white(samples + 2 * kReach), sums(samples);
    std::vector<std::vector<Amplitude>> rows(kTaps, std::vector<Amplitude>(samples));  // a ring
    for (int row = kAcross * begin; row < kAcross * begin + kTaps - 1; ++row)
      smoothed_row(seed, row, kernel, white, rows[row % kTaps]);
    for (int y = begin; y < end; ++y)
      for (int row = kAcross * y; row < kAcross * (y + 1); ++row) {
        smoothed_row(seed, row + kTaps - 1, kernel, white, rows[(row + kTaps - 1) % kTaps]);
        std::fill(sums.begin(), sums.end(), Amplitude(0.0f));
        for (int tap = 0; tap < kTaps; ++tap) {
          const std::vector<Amplitude>& smoothed = rows[(row + tap) % kTaps];
          for (std::size_t x = 0; x < samples; ++x) sums[x] += kernel[tap] * smoothed[x];
        }
        for (std::size_t x = 0; x < samples; ++x) gains(static_cast<int>(x) / kAcross, y) += part * std::norm(sums[x]);
      }
  });
  return gains;
}

double speckle_grains(const SensorModel& sensor) {
  const std::array<double, kTaps> kernel = amplitude_kernel(sensor);
  double along_axis = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      double amplitude = 0.0;  // correlation of the field at samples i and j
      for (int tap = std::abs(i - j); tap < kTaps; ++tap) amplitude += kernel[tap] * kernel[tap - std::abs(i - j)];
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
  parallel_ranges(field.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
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
