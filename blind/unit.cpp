#include "blind/unit.h"

#include <cmath>
#include <numbers>

#include "core/rng.h"

namespace fathom::blind {
namespace {

constexpr double kWidthPx = 640.0, kHeightPx = 480.0;
constexpr double kRmsPx = 0.1, kReachPx = 70.0;

/// Half waves along the rows and along the columns.
struct Wave {
  int across, down;
};

constexpr std::array<Wave, kUnitWaves> all_waves() {
  std::array<Wave, kUnitWaves> waves{};
  std::size_t count = 0;
  for (int down = 0; down < kUnitRows; ++down)
    for (int across = 0; across < kUnitColumns; ++across)
      if (across + down > 1) waves[count++] = {across, down};
  return waves;
}

constexpr std::array<Wave, kUnitWaves> kWaves = all_waves();

/// Half waves over a length, in radians per pixel.
double frequency(int half_waves, double size_px) { return std::numbers::pi * half_waves / size_px; }

/// Of a Gaussian correlation over so many pixels.
UnitBias sigmas_of(double rms_px, double reach_px) {
  UnitBias sigmas{};
  double variance = 0.0;  // of the bias, in the mean over the image
  for (std::size_t i = 0; i < kWaves.size(); ++i) {
    const auto [across, down] = kWaves[i];
    const double k2 = std::pow(frequency(across, kWidthPx), 2) + std::pow(frequency(down, kHeightPx), 2);
    sigmas[i] = std::exp(-0.25 * reach_px * reach_px * k2);
    variance += sigmas[i] * sigmas[i] * (across ? 0.5 : 1.0) * (down ? 0.5 : 1.0);
  }
  for (double& sigma : sigmas) sigma *= rms_px / std::sqrt(variance);
  return sigmas;
}

}  // namespace

const UnitBias& unit_sigmas() {
  static const UnitBias sigmas = sigmas_of(kRmsPx, kReachPx);
  return sigmas;
}

UnitBias draw_unit(std::uint64_t seed) {
  Rng rng(seed, 0x0b1a5);
  const double rms_px = kRmsPx * (0.5 + rng.uniform());
  UnitBias unit = sigmas_of(rms_px, 60.0 + 50.0 * rng.uniform());
  for (double& amplitude : unit) amplitude *= rng.normal();
  return unit;
}

double unit_px(const UnitBias& unit, const Eigen::Vector2d& reference_pixel) {
  std::array<double, kUnitColumns> across{};
  std::array<double, kUnitRows> down{};
  for (int i = 0; i < kUnitColumns; ++i) across[i] = std::cos(frequency(i, kWidthPx) * reference_pixel.x());
  for (int i = 0; i < kUnitRows; ++i) down[i] = std::cos(frequency(i, kHeightPx) * reference_pixel.y());
  double px = 0.0;
  for (std::size_t i = 0; i < kWaves.size(); ++i) px += unit[i] * across[kWaves[i].across] * down[kWaves[i].down];
  return px;
}

}  // namespace fathom::blind
