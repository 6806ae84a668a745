#include "diagnosis/predict/seen_depth.h"

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

/// What a small shift of all light that scatters at a depth moves the correlation's maximum by. Light that leaves at a
/// distance r from where it entered, shifted by δ, correlates as exp(−(r − δ)² / 2c²) with a dot; of light that is
/// symmetric about its entry the derivative of the sum vanishes at Σ K (1 − r² / 2c²) δ / Σ K (1 − r² / 2c²).
class CorrelationPeak {
 public:
  /// From the camera's side: a walk starts where light leaves and is joined to the projector, by the normal.
  void at_scattering(const Walker& walker) {
    const double depth = -walker.position.z();
    if (first_flight_ == 0.0) first_flight_ = depth;
    const double light = walker.weight * std::exp(-kMedium.scattering * depth);
    constexpr double kFaint = 1e-4;  // so deep that of all light a thousandth is left
    if (light < kFaint) return;
    const double squared = walker.position.head<2>().squaredNorm();
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

 private:
  double first_flight_ = 0.0;
  std::array<double, kCores> weight_{}, moment_{};
};

std::array<double, kCores> walked_depths() {
  const LayerSpace space({{kMedium, std::numeric_limits<double>::infinity()}});
  CorrelationPeak peak;
  for (int number = 0; number < kWalks; ++number) {
    Rng rng(kSeed, number);
    peak.start_anew();
    random_walk_of_beam(space, {Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), 1.0, 0}, rng, peak);
  }
  std::array<double, kCores> depths;
  for (int i = 0; i < kCores; ++i) depths[i] = peak.depth(i);
  return depths;
}

}  // namespace

double seen_depth(double core_paths) {
  static const std::array<double, kCores> depths = walked_depths();
  const double at = std::clamp(2.0 * (std::log2(core_paths) + 4.0), 0.0, kCores - 1.0);
  const int i = std::min(static_cast<int>(at), kCores - 2);
  return std::lerp(depths[i], depths[i + 1], at - i);
}

}  // namespace fathom
