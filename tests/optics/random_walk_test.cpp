// The walk itself: no light is lost, every way of walking expects the same, and cups are as slabs where they must be.
#include "sim/optics/random_walk.h"

#include <gtest/gtest.h>

#include "core/estimate.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/layers.h"
#include "sim/optics/straight_cup.h"
#include "tests/optics/adding_doubling.h"

namespace fathom {
namespace {

// Seeds are fixed. With a fresh seed each z-test would fail a right walk once in 16 000 times.
constexpr double kLimit = 4.0;

void expect_mean(const Mean& samples, double expected) {
  const Estimate found = samples.estimate();
  EXPECT_LT(std::fabs(found.value - expected), kLimit * found.standard_error)
      << found.value << " +- " << found.standard_error << ", expected " << expected;
}

/// Books of one walk. Absorption is booked at the scatterings, not as what is missing.
struct Books {
  double absorption_per_scattering = 0.0;
  double up = 0.0, down = 0.0, absorbed = 0.0, at_bottom = 0.0;
  void at_scattering(const Walker& walker) { absorbed += walker.weight * absorption_per_scattering; }
  void at_wall(const Walker& walker, const Eigen::Vector3d& normal, double albedo) {
    if (normal.z() == 1.0) at_bottom += walker.weight;
    absorbed += walker.weight * (1.0 - albedo);
  }
  void leaves(const Walker&, const Eigen::Vector3d& normal, double weight) { (normal.z() < 0.0 ? up : down) += weight; }
};

/// Calls `body(books)` for every walk of a unit beam that starts at the origin.
template <class Space, class Body>
void walk_often(const Space& space, const Turbid& medium, const Eigen::Vector3d& direction, std::uint64_t seed,
                Body body) {
  for (int i = 0; i < 40'000; ++i) {
    Rng rng(seed, i);
    Books books;
    if (medium.scattering > 0.0) books.absorption_per_scattering = medium.absorption / medium.scattering;
    random_walk_of_beam(space, {Eigen::Vector3d::Zero(), direction.normalized(), 1.0, 0}, rng, books);
    body(books);
  }
}

TEST(RandomWalk, ReflectedTransmittedAndAbsorbedLightMakeOne) {
  for (const Turbid medium : {Turbid{1.0, 0.1, 0.9, 0.0}, Turbid{1.33, 0.5, 0.5, 0.9}, Turbid{1.5, 0.01, 3.0, -0.4}}) {
    Mean sum;
    walk_often(LayerSpace({{medium, 2.0}}), medium, {0.3, 0.0, -1.0}, 51,
               [&](const Books& books) { sum.add(books.up + books.down + books.absorbed); });
    expect_mean(sum, 1.0);
  }
}

TEST(RandomWalk, SplittingTheBeamChangesNoExpectation) {
  const Turbid medium{1.33, 0.05, 0.8, 0.6};
  const LayerSpace space({{medium, 1.0}});
  Mean difference_up, difference_down;
  for (int i = 0; i < 40'000; ++i) {
    const Walker start{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.2, 0.0, -1.0).normalized(), 1.0, 0};
    Books split, plain;
    Rng rng(52, i), other(53, i);
    random_walk_of_beam(space, start, rng, split);
    random_walk(space, start, kRouletteShare, other, plain);
    difference_up.add(split.up - plain.up), difference_down.add(split.down - plain.down);
  }
  expect_mean(difference_up, 0.0);
  expect_mean(difference_down, 0.0);
}

TEST(RandomWalk, ScatteringsAreMetWithTheWeightThatArrives) {
  // In a thin, unbounded stretch, n = 1: first scatterings only, ∫ μs exp(−(μa + μs) z) dz.
  struct First {
    double weight = 0.0, depth = 0.0;
    bool met = false;
    void at_scattering(const Walker& walker) {
      if (!met) weight = walker.weight, depth = -walker.position.z();
      met = true;
    }
    void leaves(const Walker&, const Eigen::Vector3d&, double) {}
  };
  const double absorption = 0.7, scattering = 1.3, thickness = 0.9;
  Mean met, deep;
  for (int i = 0; i < 40'000; ++i) {
    Rng rng(54, i);
    First first;
    random_walk(LayerSpace({{{1.0, absorption, scattering, 0.8}, thickness}}),
                {Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), 1.0, 0}, kRouletteShare, rng, first);
    met.add(first.weight), deep.add(first.weight * first.depth);
  }
  const double extinction = absorption + scattering, left = std::exp(-extinction * thickness);
  expect_mean(met, scattering / extinction * (1.0 - left));
  expect_mean(deep, scattering / extinction * ((1.0 - left) / extinction - thickness * left));
}

TEST(RandomWalk, RouletteKeepsTheExpectedWeight) {
  Rng rng(55);
  Mean left;
  for (int i = 0; i < 100'000; ++i) {
    Walker walker{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 0.03, 0};
    left.add(survives(walker, 0.25, rng) ? walker.weight : 0.0);
  }
  expect_mean(left, 0.03);
}

TEST(RandomWalk, AWideBlackCupIsASlab) {
  const Turbid liquid{1.0, 0.1, 0.9, 0.75};
  Mean up, bottom;
  walk_often(StraightCupSpace(liquid, 1e4, 2.0, 0.0), liquid, {0.0, 0.0, -1.0}, 56,
             [&](const Books& books) { up.add(books.up), bottom.add(books.at_bottom); });
  const reference::SlabLight slab =
      reference::adding_doubling({.n = 1.0, .albedo = 0.9, .thickness = 2.0, .g = 0.75}, 1.0, 32);
  expect_mean(up, slab.reflectance);
  expect_mean(bottom, slab.transmittance);
}

TEST(RandomWalk, AWideClearCupShowsItsBottomAsSaundersonFound) {
  // Light that enters is sent back by the bottom and, inside, by the surface: ρ (1 − r) / (1 − ρ r), r internal.
  const Turbid liquid{1.33, 0.0, 0.0, 0.0};
  const double albedo = 0.7, inside = hemispherical_reflectance(1.33, 1.0);
  Mean up;
  walk_often(StraightCupSpace(liquid, 1e6, 0.03, albedo), liquid, {0.4, 0.0, -1.0}, 57,
             [&](const Books& books) { up.add(books.up); });
  expect_mean(up, albedo * (1.0 - inside) / (1.0 - albedo * inside));
}

TEST(RandomWalk, ACupKeepsItsBooks) {
  const Turbid liquid{1.336, 5.0, 300.0, 0.85};
  Mean sum;
  walk_often(StraightCupSpace(liquid, 0.04, 0.03, 0.8), liquid, {0.0, 0.5, -1.0}, 58,
             [&](const Books& books) { sum.add(books.up + books.absorbed); });
  expect_mean(sum, 1.0);
}

}  // namespace
}  // namespace fathom
