// Media without their forward peak, beside those that have it.
#include "sim/optics/turbid.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/estimate.h"
#include "sim/optics/layers.h"
#include "sim/optics/random_walk.h"

namespace fathom {
namespace turbid_test {

TEST(ForwardPeak, FlatOnesAreDrawnByTheirDensity) {
  for (const double g : {0.35, 0.6, 0.85, 0.98}) {
    const FlatPeak peak(0.9, g);
    constexpr int kSteps = 200'000;
    double total = 0.0, mean = 0.0, above_half = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = -1.0 + 2.0 * (i + 0.5) / kSteps;
      const double share = 2.0 * std::numbers::pi * peak.density(cosine, g) * 2.0 / kSteps;
      total += share, mean += cosine * share, above_half += cosine > 0.95 ? share : 0.0;
    }
    EXPECT_NEAR(total, 1.0, 1e-8);
    EXPECT_NEAR(peak.mean_cosine(g), mean, 1e-8);
    // The share of evenly spaced numbers that are drawn into the cone's inner half.
    int drawn = 0;
    for (int i = 0; i < kSteps; ++i) drawn += peak.sample(g, (i + 0.5) / kSteps) > 0.95;
    EXPECT_NEAR(static_cast<double>(drawn) / kSteps, above_half, 1e-5);
  }
}

TEST(ForwardPeak, ReducedScatteringStays) {
  for (const double g : {0.0, 0.2, 0.35, 0.6, 0.85, 0.98}) {
    const Turbid medium{1.33, 3.0, 4000.0, g}, flat = without_forward_peak(medium);
    const double mean = g > 0.3 ? flat.peak.mean_cosine(flat.anisotropy) : g;
    EXPECT_NEAR(flat.scattering * (1.0 - mean), medium.scattering * (1.0 - g), 1e-9 * medium.scattering);
    EXPECT_LE(flat.scattering, medium.scattering);
  }
}

/// A layer whose forward peak walks lose with their first scattering, or keep.
struct Space {
  const LayerSpace& layer;
  Turbid later;
  const Turbid& medium(const Walker& walker) const { return walker.scatterings == 0 ? layer.medium(walker) : later; }
  auto next_boundary(const Walker& walker, double reach) const { return layer.next_boundary(walker, reach); }
  template <class Visitor>
  bool meet(const LayerSpace::Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    return layer.meet(boundary, walker, rng, visitor);
  }
};

/// What a far light straight above gives back at the place where a camera's ray enters: by how far from there its own
/// light enters.
struct Returned {
  static constexpr std::array kWithin{0.5e-3, 1e-3, 2e-3, 4e-3, 1.0};  // [m]
  const Space& space;
  std::array<double, kWithin.size()> sums{};

  void at_scattering(const Walker& walker) {
    const Turbid& medium = space.medium(walker);
    const double light = walker.weight * phase_function(medium, walker.direction.z()) *
                         std::exp((medium.absorption + medium.scattering) * walker.position.z());
    const double aside = walker.position.head<2>().norm();
    for (std::size_t i = 0; i < kWithin.size(); ++i)
      if (aside < kWithin[i]) sums[i] += light;
  }
  void leaves(const Walker&, const Eigen::Vector3d&, double) {}
};

TEST(ForwardPeak, LeavingItOutAfterTheFirstScatteringKeepsTheLight) {
  // What the core within a millimetre may gain, and all light together: bounds, to which 4 standard errors are added. A
  // fresh seed would fail once in some thousand runs.
  constexpr std::array kBounds{0.04, 0.04, 0.04, 0.03, 0.005};
  struct Case {
    double n, scattering, anisotropy;
    int walks;
  };
  for (const Case& liquid :
       {Case{1.336, 3333.3, 0.85, 60'000}, Case{1.344, 1500.0, 0.9, 200'000}, Case{1.342, 1000.0, 0.6, 60'000}}) {
    const Turbid medium{liquid.n, 3.0, liquid.scattering, liquid.anisotropy};
    const LayerSpace layer({{medium, 0.03}});
    const Space as_it_is{layer, medium}, flat{layer, without_forward_peak(medium)};
    std::array<Mean, Returned::kWithin.size()> exact, changed;
    for (int i = 0; i < liquid.walks; ++i) {
      const Walker start{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.3, 0.0, -1.0).normalized(), 1.0, 0};
      Returned of_exact{as_it_is}, of_flat{flat};
      Rng rng(71, i), other(72, i);
      random_walk_of_beam(as_it_is, start, rng, of_exact);
      random_walk_of_beam(flat, start, other, of_flat);
      for (std::size_t k = 0; k < exact.size(); ++k) exact[k].add(of_exact.sums[k]), changed[k].add(of_flat.sums[k]);
    }
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const Estimate one = exact[k].estimate(), other = changed[k].estimate();
      const double error = std::hypot(one.standard_error, other.standard_error) / one.value;
      EXPECT_LT(std::fabs(other.value / one.value - 1.0), kBounds[k] + 4.0 * error)
          << "mu_s " << liquid.scattering << ", within " << Returned::kWithin[k] << " m: " << other.value << " and "
          << one.value << " +- " << one.standard_error;
      EXPECT_LT(error, 0.05) << "the bound says nothing";
    }
  }
}

}  // namespace turbid_test
}  // namespace fathom
