#include "diagnosis/predict/turbid_dots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/optics/layers.h"

namespace fathom {
namespace {

constexpr Turbid kMedium{.n = 1.336, .absorption = 0.003, .scattering = 1.0, .anisotropy = 0.0};
constexpr int kCores = 21, kWalks = 10'000;
constexpr std::uint64_t kSeed = 0x6465707468ULL;

/// From 1/16 of a path to 64 in steps of √2.
double core_of(int i) { return std::exp2(0.5 * i - 4.0); }

/// Rings about the point where light entered, in which it leaves again: from 1/64 of a path to 256, in steps of 2^¼.
constexpr int kRings = 64;
double ring(int i) { return std::exp2(0.25 * i - 6.0); }

/// What a small shift of all light that scatters at a depth moves the correlation's maximum by. Light that leaves at a
/// distance r from where it entered, shifted by δ, correlates as exp(−(r − δ)² / 2c²) with a dot; of light that is
/// symmetric about its entry the derivative of the sum vanishes at Σ K (1 − r² / 2c²) δ / Σ K (1 − r² / 2c²).
class ReturnedLight {
 public:
  /// From the camera's side: a walk starts where light leaves and is joined to the projector, by the normal.
  void at_scattering(const Walker& walker) {
    const double depth = -walker.position.z();
    if (first_flight_ == 0.0) first_flight_ = depth;
    const double light = walker.weight * std::exp(-kMedium.scattering * depth);
    constexpr double kFaint = 1e-4;  // so deep that of all light a thousandth is left
    if (light < kFaint) return;
    const double squared = walker.position.head<2>().squaredNorm();
    const double number = std::round(2.0 * std::log2(std::max(squared, ring(0) * ring(0))) + 24.0);
    by_ring_[static_cast<std::size_t>(std::clamp(number, 0.0, kRings - 1.0))] += light;
    for (int i = 0; i < kCores; ++i) {
      const double in_cores = 0.5 * squared / (core_of(i) * core_of(i));
      const double weight = light * std::exp(-in_cores) * (1.0 - in_cores);
      weight_[i] += weight;
      moment_[i] += weight * 0.5 * (first_flight_ + depth);
    }
  }
  void leaves(const Walker&, const Eigen::Vector3d&, double) {}

  void start_anew() { first_flight_ = 0.0; }
  double depth(int i) const { return moment_[i] / weight_[i]; }

  /// K̂(q), by the transform of each ring.
  double transform(double q) const {
    double sum = 0.0, all = 0.0;
    for (int i = 0; i < kRings; ++i) {
      all += by_ring_[i];
      sum += by_ring_[i] * (i == 0 ? 1.0 : std::cyl_bessel_j(0.0, q * ring(i)));
    }
    return sum / all;
  }

 private:
  double first_flight_ = 0.0;
  std::array<double, kCores> weight_{}, moment_{};
  std::array<double, kRings> by_ring_{};
};

/// √ of the mean of K̂² over the power spectrum of dots, whose share up to q is 1 − exp(−q²c²/2).
double contrast_by(const ReturnedLight& light, double core) {
  constexpr int kShares = 40;
  double sum = 0.0;
  for (int i = 0; i < kShares; ++i) {
    const double q = std::sqrt(-2.0 * std::log(1.0 - (i + 0.5) / kShares)) / core;
    sum += std::pow(light.transform(q), 2) / kShares;
  }
  return std::sqrt(sum);
}

struct OfCores {
  std::array<double, kCores> depth, contrast;
};

OfCores walked() {
  const LayerSpace space({{kMedium, std::numeric_limits<double>::infinity()}});
  ReturnedLight light;
  for (int number = 0; number < kWalks; ++number) {
    Rng rng(kSeed, number);
    light.start_anew();
    random_walk_of_beam(space, {Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), 1.0, 0}, rng, light);
  }
  OfCores result;
  for (int i = 0; i < kCores; ++i) {
    result.depth[i] = light.depth(i);
    result.contrast[i] = contrast_by(light, core_of(i));
  }
  return result;
}

const OfCores& of_cores() {
  static const OfCores once = walked();
  return once;
}

double interpolated(const std::array<double, kCores>& values, double core_paths) {
  const double at = std::clamp(2.0 * (std::log2(core_paths) + 4.0), 0.0, kCores - 1.0);
  const int i = std::min(static_cast<int>(at), kCores - 2);
  return std::lerp(values[i], values[i + 1], at - i);
}

}  // namespace

double seen_depth(double core_paths) { return interpolated(of_cores().depth, core_paths); }

double dot_contrast(double core_paths) { return interpolated(of_cores().contrast, core_paths); }

}  // namespace fathom
