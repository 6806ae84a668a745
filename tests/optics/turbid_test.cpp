// Media without their forward peak, beside those that have it.
#include "sim/optics/turbid.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/estimate.h"
#include "sim/optics/random_walk.h"
#include "sim/optics/straight_cup.h"

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

/// A wide cup in which walks lose the forward peak with their first scattering, or keep it.
struct Space {
  const StraightCupSpace& cup;
  Turbid first, later;
  const Turbid& medium(const Walker& walker) const { return walker.scatterings == 0 ? first : later; }
  auto next_boundary(const Walker& walker, double reach) const { return cup.next_boundary(walker, reach); }
  template <class Visitor>
  bool meet(const StraightCupSpace::Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    return cup.meet(boundary, walker, rng, visitor);
  }
};

/// What a far light straight above gives back where a camera's ray enters, joined to it as `render/light_walk` does: of
/// light that enters within 2 mm of there, and of all.
struct Returned {
  const Space& space;
  double near = 0.0, all = 0.0;

  void at_scattering(const Walker& walker) {
    add(walker, phase_function(space.medium(walker), walker.direction.z()), space.later);
  }
  void at_wall(const Walker& walker, const Eigen::Vector3d& normal, double albedo) {
    if (normal.z() == 1.0) add(walker, albedo / std::numbers::pi, space.medium(walker));
  }
  void add(const Walker& walker, double sent_on, const Turbid& above) {
    const double light = walker.weight * sent_on * std::exp(above.extinction() * walker.position.z());
    all += light;
    if (walker.position.head<2>().norm() < 2e-3) near += light;
  }
  void leaves(const Walker&, const Eigen::Vector3d&, double) {}
};

TEST(ForwardPeak, LeavingItOutKeepsTheLight) {
  // What may change within 2 mm and in all: bounds, to which 4 standard errors are added; a fresh seed would fail once
  // in some thousand runs. Thin liquids send little back near the beam, so that all of it is what counts.
  constexpr double kNear = 0.05, kAll = 0.01;
  struct Case {
    double scattering, anisotropy;
    int walks;
  };
  for (const Case& liquid : {Case{3333.3, 0.85, 120'000}, Case{1500.0, 0.9, 250'000}, Case{1000.0, 0.6, 60'000},
                             Case{70.0, 0.85, 200'000}, Case{30.0, 0.9, 200'000}}) {
    constexpr double kIndex = 1.336, kRadius = 1.0, kDepth = 0.03, kAlbedo = 0.6;
    const Turbid medium{kIndex, 3.0, liquid.scattering, liquid.anisotropy};
    const StraightCupSpace cup(medium, kRadius, kDepth, kAlbedo);
    const Space as_it_is{cup, medium, medium}, flat{cup, medium, without_forward_peak(medium)};
    Mean near, all, flat_near, flat_all;
    for (int i = 0; i < liquid.walks; ++i) {
      const Walker start{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.3, 0.0, -1.0).normalized(), 1.0, 0};
      Returned of_exact{as_it_is}, of_flat{flat};
      Rng rng(71, i), other(72, i);
      random_walk_of_beam(as_it_is, start, rng, of_exact);
      random_walk_of_beam(flat, start, other, of_flat);
      near.add(of_exact.near), all.add(of_exact.all);
      flat_near.add(of_flat.near), flat_all.add(of_flat.all);
    }
    const auto expect_alike = [&](const Mean& one, const Mean& other, double bound, const char* what) {
      const Estimate exact = one.estimate(), changed = other.estimate();
      const double error = std::hypot(exact.standard_error, changed.standard_error) / exact.value;
      EXPECT_LT(std::fabs(changed.value / exact.value - 1.0), bound + 4.0 * error)
          << what << ", mu_s " << liquid.scattering << ": " << changed.value << " and " << exact.value << " +- "
          << 100.0 * error << " %";
      EXPECT_LT(error, 0.6 * bound) << what << ", mu_s " << liquid.scattering << ": the bound says nothing";
    };
    expect_alike(all, flat_all, kAll, "all");
    if (liquid.scattering > 500.0) expect_alike(near, flat_near, kNear, "within 2 mm");
  }
}

}  // namespace turbid_test
}  // namespace fathom
