// Turbid layers: against adding and doubling, in closed limits, and in balance.
#include "sim/optics/layer_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "sim/optics/walk_length.h"
#include "tests/optics/adding_doubling.h"

namespace fathom {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

LayerLight slab(const Turbid& medium, double thickness, double angle_deg, const SamplingPlan& plan = {}) {
  return light_in_layers(LayerSpace({{medium, thickness}}), radians_from_deg(angle_deg), 1, plan);
}

TEST(AddingDoubling, GivesThePublishedValues) {
  const auto expect = [](const reference::Slab& slab, double cosine, double reflectance, double transmittance) {
    const reference::SlabLight found = reference::adding_doubling(slab, cosine, 48);
    // A unit of the last printed digit.
    EXPECT_NEAR(found.reflectance, reflectance, 1e-5);
    EXPECT_NEAR(found.transmittance, transmittance, 1e-5);
  };
  // van de Hulst 1980
  expect({.n = 1.0, .albedo = 0.9, .thickness = 2.0, .g = 0.75}, 1.0, 0.09739, 0.66096);
  expect({.n = 1.0, .albedo = 0.99, .thickness = 1.0, .g = 0.0}, 0.5, 0.48652, 0.49163);
  expect({.n = 1.0, .albedo = 0.99, .thickness = 4.0, .g = 0.5}, 0.5, 0.61996, 0.30605);
  // Chandrasekhar 1950, 1 − √(1 − a) H(1)
  expect({.n = 1.0, .albedo = 0.5, .thickness = 100.0, .g = 0.0}, 1.0, 0.11523, 0.0);
  expect({.n = 1.0, .albedo = 0.999, .thickness = 1000.0, .g = 0.0}, 1.0, 0.91285, 0.0);
  // Giovanelli 1955
  EXPECT_NEAR(reference::adding_doubling({.n = 1.5, .albedo = 0.9, .thickness = 100.0, .g = 0.0}, 1.0, 48).reflectance,
              0.2600, 1e-4);
}

/// In standard errors; what the reference still changes by with its number of angles is an error of its own.
double deviation(const Estimate& found, double reference, double coarse_reference) {
  return (found.value - reference) / std::hypot(found.standard_error, reference - coarse_reference);
}

TEST(LayerLight, AgreesWithAddingAndDoublingOnRandomSlabs) {
  Rng rng(41);
  for (int i = 0; i < 24; ++i) {
    const reference::Slab drawn{.n = i % 4 == 0 ? 1.0 : 1.0 + 0.6 * rng.uniform(),
                                .albedo = i % 5 == 0 ? 1.0 : 1.0 - std::exp(-6.0 * rng.uniform()),
                                .thickness = std::exp(6.0 * rng.uniform() - 3.0),
                                .g = 1.6 * rng.uniform() - 0.7};
    const double cosine = 0.05 + 0.95 * rng.uniform();
    const reference::SlabLight fine = reference::adding_doubling(drawn, cosine, 64);
    const reference::SlabLight coarse = reference::adding_doubling(drawn, cosine, 32);
    const LayerLight found = slab({drawn.n, 1.0 - drawn.albedo, drawn.albedo, drawn.g}, drawn.thickness,
                                  deg_from_radians(std::acos(cosine)), {.samples = 60'000});
    // 48 comparisons; with a fresh seed one of them fails a right program once in 330 times.
    EXPECT_LT(std::fabs(deviation(found.reflectance, fine.reflectance, coarse.reflectance)), 4.0) << fmt::format(
        "n {} albedo {} thickness {} g {} cosine {}: {} +- {}, {}", drawn.n, drawn.albedo, drawn.thickness, drawn.g,
        cosine, found.reflectance.value, found.reflectance.standard_error, fine.reflectance);
    EXPECT_LT(std::fabs(deviation(found.transmittance, fine.transmittance, coarse.transmittance)), 4.0) << fmt::format(
        "n {} albedo {} thickness {} g {} cosine {}: {} +- {}, {}", drawn.n, drawn.albedo, drawn.thickness, drawn.g,
        cosine, found.transmittance.value, found.transmittance.standard_error, fine.transmittance);
  }
}

TEST(LayerLight, CutIntoLayersASlabStaysTheSame) {
  const Turbid medium{1.4, 20.0, 900.0, 0.7};
  const LayerSpace cut({{medium, 0.0005}, {medium, 0.0013}, {medium, 0.0002}});
  const LayerLight parts = light_in_layers(cut, 0.5, 7, {.samples = 100'000});
  const reference::SlabLight whole =
      reference::adding_doubling({.n = 1.4, .albedo = 900.0 / 920.0, .thickness = 1.84, .g = 0.7}, std::cos(0.5), 64);
  // 4 standard errors: once in 16 000 times.
  EXPECT_LT(std::fabs(parts.reflectance.value - whole.reflectance), 4.0 * parts.reflectance.standard_error);
  EXPECT_LT(std::fabs(parts.transmittance.value - whole.transmittance), 4.0 * parts.transmittance.standard_error);
}

TEST(LayerLight, AClearSlabIsTheSeriesOfItsReflections) {
  const double n = 1.5, absorption = 30.0, thickness = 0.01, angle_deg = 50.0;
  const double cosine = std::cos(radians_from_deg(angle_deg));
  const double cos_inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
  const double r = fresnel_reflectance(cosine, 1.0, n), through = std::exp(-absorption * thickness / cos_inside);
  const double transmittance = (1.0 - r) * (1.0 - r) * through / (1.0 - r * r * through * through);
  const double reflectance = r + r * through * transmittance;
  const LayerLight found = slab({n, absorption, 0.0, 0.0}, thickness, angle_deg);
  EXPECT_EQ(found.specular, r);
  // 4 standard errors: once in 16 000 times.
  EXPECT_LT(std::fabs(found.reflectance.value - reflectance), 4.0 * found.reflectance.standard_error);
  EXPECT_LT(std::fabs(found.transmittance.value - transmittance), 4.0 * found.transmittance.standard_error);
  EXPECT_FALSE(found.absorptance);
}

TEST(LayerLight, EmptyLayersLetEverythingThrough) {
  const LayerLight found = slab({}, 0.01, 89.9);
  EXPECT_NEAR(found.reflectance.value, 0.0, 1e-20);  // the square of what rounding leaves at 89.9 degrees
  EXPECT_EQ(found.transmittance.value, 1.0);
}

TEST(LayerLight, WhereNothingIsLostAHalfSpaceGivesAllBack) {
  const LayerLight found = slab({1.33, 0.0, 1000.0, 0.9}, kInfinite, 30.0);
  EXPECT_EQ(found.reflectance.value, 1.0);
  EXPECT_EQ(found.transmittance.value, 0.0);
  // Chandrasekhar's 1 - sqrt(1 - a) H(1) with H(1) < 3: 0.997 at an albedo of 1 - 1e-6.
  const LayerLight nearly = slab({1.0, 1e-6, 1.0, 0.0}, kInfinite, 0.0, {.samples = 2000});
  EXPECT_GT(nearly.reflectance.value, 0.997 - 4.0 * nearly.reflectance.standard_error);
}

TEST(LayerLight, ALessDenseSlabReflectsTotallyBeyondTheCriticalAngle) {
  const LayerLight found = slab({0.8, 10.0, 100.0, 0.5}, 0.01, 60.0);
  EXPECT_EQ(found.reflectance.value, 1.0);
  EXPECT_EQ(found.specular, 1.0);
}

TEST(LayerLight, ErrorsAreAsSmallAsThePlanAsks) {
  const LayerLight found = slab({1.33, 3.0, 3000.0, 0.85}, 0.002, 20.0);
  EXPECT_TRUE(found.reached);
  EXPECT_LE(found.reflectance.standard_error, 0.002 * found.reflectance.value);
  EXPECT_LE(found.transmittance.standard_error, 0.002 * found.transmittance.value);
  const LayerLight short_of_work = slab({1.33, 3.0, 3000.0, 0.85}, 0.002, 20.0, {.most_work = 10'000});
  EXPECT_FALSE(short_of_work.reached);
}

TEST(LayerLight, AnEndlessWalkIsRefused) {
  const LayerSpace space({{{1.3, 1.0, 10.0, 0.0}, 0.01}, {{1.3, 0.0, 10.0, 0.0}, kInfinite}});
  EXPECT_THROW(light_in_layers(space, 0.0, 1, {}), Error);
}

/// A space that counts what a walk meets and where it scatters.
struct Counted {
  const LayerSpace& space;
  mutable std::uint64_t steps = 0;
  const Turbid& medium(const Walker& walker) const { return space.medium(walker); }
  LayerSpace::Boundary next_boundary(const Walker& walker, double reach) const {
    ++steps;
    return space.next_boundary(walker, reach);
  }
  template <class Visitor>
  bool meet(const LayerSpace::Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    return space.meet(boundary, walker, rng, visitor);
  }
};

struct Nobody {
  void at_scattering(const Walker&) {}
  void leaves(const Walker&, const Eigen::Vector3d&, double) {}
};

TEST(WalkLength, IsBoundedBeforeTheFirstWalk) {
  const Layer slabs[] = {
      {{1.0, 0.0, 1.0, 0.0}, 0.01},                                       // hardly scatters
      {{1.33, 0.0, 1.0, 0.0}, 100.0},                                     // conservative and thick
      {{1.33, 0.0, 1.0, 0.95}, 300.0},                                    // the same, forwards
      {{1.33, 0.0, 1.0, -0.9}, 300.0},                                    // and backwards
      {{10.0, 0.0, 1.0, 0.0}, 30.0},                                      // hard to leave
      {{0.05, 0.0, 1.0, 0.0}, 30.0},                                      // hard to leave as well
      {{1.5, 0.0, 1.0, 0.0}, 0.001},                                      // guides what it has scattered
      {{1.5, 0.0, 1e-9, 0.0}, 1e6},                                       // the same in other units
      {{1.33, 1e-4, 1.0, 0.0}, kInfinite},                                // absorbs at depth
      {{1.33, 1e-3, 1.0, 0.9}, kInfinite}, {{1.33, 1.0, 0.0, 0.0}, 1.0},  // does not scatter
  };
  for (const Layer& slab : slabs)
    for (const double angle : {0.0, 1.2}) {
      const double specular = fresnel_reflectance(std::cos(angle), 1.0, slab.medium.n);
      const auto inside =
          refract({std::sin(angle), 0.0, -std::cos(angle)}, Eigen::Vector3d::UnitZ(), 1.0, slab.medium.n);
      if (!inside) {
        EXPECT_EQ(expected_steps(slab, angle), 0.0);
        continue;
      }
      const LayerSpace space({slab});
      const Counted counted{space};
      constexpr int kWalks = 500;  // their mean is known to some ten percent
      for (std::uint64_t i = 0; i < kWalks; ++i) {
        Rng rng(5, i);
        Nobody nobody;
        random_walk_of_beam(counted, {Eigen::Vector3d::Zero(), *inside, 1.0 - specular, 0}, rng, nobody);
      }
      const double mean = static_cast<double>(counted.steps) / kWalks;
      const std::string what =
          fmt::format("n {} μa {} μs {} g {} d {} at {} rad: {} steps", slab.medium.n, slab.medium.absorption,
                      slab.medium.scattering, slab.medium.anisotropy, slab.thickness, angle, mean);
      // The beam's first flight and both of its parts are three steps that the estimate leaves out.
      EXPECT_GT(expected_steps(slab, angle) + 3.0, mean) << what;
      EXPECT_LT(expected_steps(slab, angle), 100.0 * mean) << what;
    }
}

}  // namespace
}  // namespace fathom
