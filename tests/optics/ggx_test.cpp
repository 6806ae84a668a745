// Rough and glazed surfaces: normalised, reciprocal, sampled as their densities say, and never brighter than the light.
#include "sim/optics/ggx.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "core/units.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/glaze.h"
#include "tests/core/chi_squared.h"

namespace fathom {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAir = 1.0, kCoat = 1.5;

Eigen::Vector3d direction(double polar_deg, double azimuth_deg) {
  const double t = radians_from_deg(polar_deg), p = radians_from_deg(azimuth_deg);
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// ∫ f dω over the hemisphere by the midpoint rule in cos²-like steps that crowd at the pole, where rough lobes are
/// narrow.
template <class Function>
double over_hemisphere(Function f) {
  constexpr int kPolar = 1500, kAzimuth = 360;
  double sum = 0.0;
  for (int i = 0; i < kPolar; ++i) {
    const double t = (i + 0.5) / kPolar, polar = 0.5 * kPi * t * t;  // dθ = π t dt
    for (int j = 0; j < kAzimuth; ++j) {
      const double azimuth = 2.0 * kPi * (j + 0.5) / kAzimuth;
      const Eigen::Vector3d w(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                              std::cos(polar));
      sum += f(w) * std::sin(polar) * t;
    }
  }
  return sum * kPi / kPolar * 2.0 * kPi / kAzimuth;
}

TEST(Ggx, FacetsCoverTheSurfaceOnce) {
  for (const double alpha : {0.05, 0.3, 1.0})
    EXPECT_NEAR(over_hemisphere([&](const auto& m) { return ggx_density(m, alpha) * m.z(); }), 1.0, 1e-4)  // the rule's
        << alpha;
}

TEST(Ggx, ADirectionSeesItsOwnProjectionOfFacets) {
  // The weak white furnace in its first form: ∫ G1 max(0, w·m) D dm = cos θ, that is ∫ pdf = 1.
  for (const double alpha : {0.1, 0.5})
    for (const double polar_deg : {0.0, 40.0, 75.0}) {
      const Eigen::Vector3d from = direction(polar_deg, 20.0);
      EXPECT_NEAR(over_hemisphere([&](const auto& m) { return visible_normal_pdf(from, m, alpha); }), 1.0, 1e-3)
          << alpha << ", " << polar_deg;  // the kink at w·m = 0 costs the rule 1e-4 and more
    }
}

TEST(Ggx, WithoutShadowingAWhiteSurfaceReflectsEverything) {
  // The weak white furnace (Heitz 2014, Eq. 115): ∫ G1(from) D(half) / (4 cos θ_from) dω = 1, over all directions.
  for (const double alpha : {0.2, 0.6}) {
    const Eigen::Vector3d from = direction(50.0, 0.0);
    const auto brdf = [&](const Eigen::Vector3d& to) {
      const Eigen::Vector3d half = (from + to).normalized();
      return half.z() > 0.0 ? visible_normal_pdf(from, half, alpha) / (4.0 * from.dot(half)) : 0.0;
    };
    const double above = over_hemisphere(brdf);
    const double below = over_hemisphere([&](const Eigen::Vector3d& to) { return brdf({to.x(), to.y(), -to.z()}); });
    EXPECT_NEAR(above + below, 1.0, 2e-3) << alpha;  // the rule's
  }
}

/// Counts of a sampler over bins of cos θ and azimuth against the density integrated over each bin.
template <class Sample, class Density>
ChiSquared compare(Sample sample, Density density) {
  constexpr int kPolar = 20, kAzimuth = 24, kDraws = 100'000, kInner = 12;
  std::vector<double> counts(kPolar * kAzimuth + 1, 0.0), expected(counts.size(), 0.0);
  Rng rng(21);
  for (int i = 0; i < kDraws; ++i) {
    const std::optional<Eigen::Vector3d> w = sample(rng.uniform(), rng.uniform());
    if (!w) {
      counts.back() += 1.0;
      continue;
    }
    const double azimuth = std::atan2(w->y(), w->x()) / (2.0 * kPi) + 0.5;
    const int row = std::min(static_cast<int>(w->z() * kPolar), kPolar - 1);
    const int column = std::min(static_cast<int>(azimuth * kAzimuth), kAzimuth - 1);
    counts[row * kAzimuth + column] += 1.0;
  }
  double inside = 0.0;
  for (int row = 0; row < kPolar; ++row)
    for (int column = 0; column < kAzimuth; ++column)
      for (int i = 0; i < kInner; ++i)
        for (int j = 0; j < kInner; ++j) {
          const double z = (row + (i + 0.5) / kInner) / kPolar, r = std::sqrt(1.0 - z * z);
          const double azimuth = 2.0 * kPi * ((column + (j + 0.5) / kInner) / kAzimuth - 0.5);
          const double share = density(Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z)) * 2.0 * kPi /
                               (kPolar * kAzimuth * kInner * kInner);
          expected[row * kAzimuth + column] += share * kDraws;
          inside += share;
        }
  expected.back() = std::max(1.0 - inside, 0.0) * kDraws;
  return chi_squared(counts, expected);
}

// The seed is fixed; with a fresh one each chi² below would fail a right sampler once in 10 000 times.
TEST(Ggx, NormalsAreSampledAsTheirDensitySays) {
  for (const double alpha : {0.3, 0.8})
    for (const double polar_deg : {0.0, 45.0, 80.0}) {
      const Eigen::Vector3d from = direction(polar_deg, 130.0);
      const ChiSquared found =
          compare([&](double u1, double u2) { return std::optional(sample_visible_normal(from, alpha, u1, u2)); },
                  [&](const Eigen::Vector3d& m) { return visible_normal_pdf(from, m, alpha); });
      EXPECT_TRUE(found.passes()) << alpha << ", " << polar_deg << ": " << found.value << " of " << found.degrees;
    }
}

TEST(Ggx, ReflectionsAreSampledAsTheirDensitySays) {
  for (const double alpha : {0.3, 0.8})
    for (const double polar_deg : {0.0, 45.0, 70.0}) {
      const Eigen::Vector3d from = direction(polar_deg, 130.0);
      const ChiSquared found = compare(
          [&](double u1, double u2) -> std::optional<Eigen::Vector3d> {
            const auto sample = sample_ggx_reflection(from, alpha, kAir, kCoat, u1, u2);
            return sample ? std::optional(sample->to) : std::nullopt;
          },
          [&](const Eigen::Vector3d& to) { return ggx_reflection_pdf(from, to, alpha); });
      EXPECT_TRUE(found.passes()) << alpha << ", " << polar_deg << ": " << found.value << " of " << found.degrees;
    }
}

TEST(Ggx, TheSamplersWeightIsReflectionOverDensity) {
  Rng rng(22);
  for (int i = 0; i < 1000; ++i) {
    const double alpha = 0.01 + rng.uniform();
    const Eigen::Vector3d from = direction(89.0 * rng.uniform(), 360.0 * rng.uniform());
    const auto sample = sample_ggx_reflection(from, alpha, kAir, kCoat, rng.uniform(), rng.uniform());
    if (!sample) continue;
    const double ratio = ggx_reflection(from, sample->to, alpha, kAir, kCoat) * sample->to.z() /
                         ggx_reflection_pdf(from, sample->to, alpha);
    EXPECT_NEAR(sample->weight / ratio, 1.0, 1e-9);  // roundings of the half vector, sharpened by 1/α²
  }
}

TEST(Ggx, ReflectionIsReciprocalAndLosesLightOnlyToTheInside) {
  Rng rng(23);
  for (const double alpha : {0.1, 0.4, 1.0})
    for (const double polar_deg : {0.0, 30.0, 60.0, 85.0}) {
      const Eigen::Vector3d from = direction(polar_deg, 0.0);
      double white = 0.0;
      constexpr int kDraws = 20000;
      for (int i = 0; i < kDraws; ++i) {
        const double u1 = rng.uniform(), u2 = rng.uniform();
        const auto sample = sample_ggx_reflection(from, alpha, kAir, kCoat, u1, u2);
        if (!sample) continue;
        const double there = ggx_reflection(from, sample->to, alpha, kAir, kCoat);
        const double back = ggx_reflection(sample->to, from, alpha, kAir, kCoat);
        ASSERT_NEAR(there, back, 1e-12 * there);  // a few roundings
        // Without Fresnel: an interface to an index so high that it reflects everything, to 4/n.
        white += sample_ggx_reflection(from, alpha, kAir, 1e9, u1, u2)->weight / kDraws;
      }
      EXPECT_LE(white, 1.0 + 1e-8) << alpha << ", " << polar_deg;
    }
}

TEST(Ggx, ASlightRoughnessIsAlmostAMirror) {
  const Eigen::Vector3d from = direction(50.0, 0.0), mirror = direction(50.0, 180.0);
  const double fresnel = fresnel_reflectance(from.z(), kAir, kCoat);
  const auto smooth = sample_ggx_reflection(from, 0.0, kAir, kCoat, 0.3, 0.7);
  EXPECT_LT((smooth->to - mirror).norm(), 1e-15);
  EXPECT_EQ(smooth->weight, fresnel);
  const auto rough = sample_ggx_reflection(from, 1e-3, kAir, kCoat, 0.3, 0.7);  // slopes of about α
  EXPECT_LT((rough->to - mirror).norm(), 1e-2);
  EXPECT_NEAR(rough->weight / fresnel, 1.0, 1e-2);
}

TEST(Glaze, AWhiteBaseGivesBackAllLight) {
  Rng rng(24);
  for (const double roughness : {0.0, 0.2, 0.6}) {
    const Glaze glaze(1.0, roughness, kAir, kCoat);
    for (const double polar_deg : {0.0, 45.0, 70.0}) {
      const Eigen::Vector3d from = direction(polar_deg, 0.0);
      EXPECT_NEAR(glaze.albedo(from.z()), 1.0, 1e-12);
      // By Monte Carlo, with cosine-distributed directions for what comes out and the sampler for the surface.
      constexpr int kDraws = 100'000;
      double sum = 0.0, squares = 0.0;
      for (int i = 0; i < kDraws; ++i) {
        const auto coat = sample_ggx_reflection(from, roughness, kAir, kCoat, rng.uniform(), rng.uniform());
        const double radius = std::sqrt(rng.uniform()), azimuth = 2.0 * kPi * rng.uniform();
        const Eigen::Vector3d to(radius * std::cos(azimuth), radius * std::sin(azimuth),
                                 std::sqrt(1.0 - radius * radius));
        const double back = (coat ? coat->weight : 0.0) + glaze.diffuse(from, to) * kPi;
        sum += back;
        squares += back * back;
      }
      const double mean = sum / kDraws, error = std::sqrt((squares / kDraws - mean * mean) / kDraws);
      EXPECT_LT(error, 1e-3);
      EXPECT_NEAR(mean, 1.0, 4.0 * error) << roughness << ", " << polar_deg;  // 4 SE: once in 16 000 with a fresh seed
    }
  }
}

TEST(Glaze, IsSampledAsItReflects) {
  // The mean of a sample's weight times a function of its direction is the integral of the function over the BRDF.
  Rng rng(25);
  const Glaze glaze(0.8, 0.3, 1.33, kCoat);
  const auto above = [](const Eigen::Vector3d& to) { return to.x() > 0.3 ? to.z() : 0.0; };
  for (const double polar_deg : {0.0, 45.0, 70.0}) {
    const Eigen::Vector3d from = direction(polar_deg, 180.0);
    constexpr int kDraws = 100'000;
    double all = 0.0, sum = 0.0, squares = 0.0, all_squares = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const auto sample = glaze.sample(from, rng);
      const double weight = sample ? sample->weight : 0.0, one = sample ? weight * above(sample->to) : 0.0;
      all += weight, all_squares += weight * weight;
      sum += one, squares += one * one;
    }
    const auto error = [](double s, double q) { return std::sqrt((q / kDraws - s * s / kDraws / kDraws) / kDraws); };
    EXPECT_NEAR(all / kDraws, glaze.albedo(from.z()), 4.0 * error(all, all_squares));  // 4 SE, as above
    const double expected =
        over_hemisphere([&](const auto& to) { return glaze.reflection(from, to) * to.z() * above(to); });
    EXPECT_NEAR(sum / kDraws, expected, 4.0 * error(sum, squares)) << polar_deg;
    EXPECT_LT(error(sum, squares), 0.01 * expected);
  }
}

TEST(Glaze, IsReciprocalAndItsAlbedoIsSaundersons) {
  const Glaze smooth(0.8, 0.0, kAir, kCoat), rough(0.8, 0.3, kAir, kCoat);
  const Eigen::Vector3d a = direction(20.0, 10.0), b = direction(65.0, 200.0);
  for (const Glaze* glaze : {&smooth, &rough})
    EXPECT_NEAR(glaze->reflection(a, b) / glaze->reflection(b, a), 1.0, 1e-13);
  // Saunderson 1942 for light at cos θ: T ρ (1 − r) / (1 − ρ r) with Walsh's r from within.
  const double within = hemispherical_reflectance(kCoat, kAir);
  const double through = 1.0 - fresnel_reflectance(a.z(), kAir, kCoat);
  EXPECT_NEAR(smooth.albedo(a.z()), 1.0 - through + through * 0.8 * (1.0 - within) / (1.0 - 0.8 * within),
              1e-5);  // both rules'
  EXPECT_LT(rough.albedo(a.z()), 1.0);
  EXPECT_EQ(smooth.diffuse(a, direction(120.0, 0.0)), 0.0);
}

}  // namespace
}  // namespace fathom
