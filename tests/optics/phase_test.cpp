// Sampled directions against their densities.
#include "sim/optics/phase.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <vector>

#include "core/estimate.h"

namespace fathom {
namespace {

constexpr int kBins = 64;

/// Cosines from −1 to 1, dense where forward (g > 0) or backward light is: 1 − cos = 2 t⁴, or mirrored.
double cosine_at(double t, double g) {
  const double forward = 1.0 - 2.0 * std::pow(1.0 - t, 4.0);
  return g >= 0.0 ? forward : -(1.0 - 2.0 * std::pow(t, 4.0));
}

/// ∫ p dω between two parameters of cosine_at(), by the midpoint rule.
double share_between(double low, double high, double g) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = low + (high - low) * i / kSteps, next = low + (high - low) * (i + 1) / kSteps;
    sum += henyey_greenstein(cosine_at(0.5 * (t + next), g), g) * (cosine_at(next, g) - cosine_at(t, g));
  }
  return 2.0 * std::numbers::pi * sum;
}

TEST(Phase, SamplerFollowsTheDensity) {
  constexpr int kDraws = 200'000;
  for (const double g : {-0.99, -0.5, -1e-9, 0.0, 1e-4, 0.5, 0.85, 0.99}) {
    Rng rng(31, static_cast<std::uint64_t>(1000.0 * (g + 1.0)));
    std::vector<double> edges, expected;
    double total = 0.0;
    for (int i = 0; i < kBins; ++i) {
      expected.push_back(kDraws * share_between(static_cast<double>(i) / kBins, (i + 1.0) / kBins, g));
      edges.push_back(cosine_at((i + 1.0) / kBins, g));
      total += expected.back();
    }
    EXPECT_NEAR(total / kDraws, 1.0, 1e-5) << g;  // the midpoint rule over the peak at g = 0.99
    std::vector<int> counts(kBins);
    for (int i = 0; i < kDraws; ++i) {
      const double cosine = sample_henyey_greenstein(g, rng.uniform());
      ++counts[static_cast<std::size_t>(
          std::min<std::ptrdiff_t>(std::upper_bound(edges.begin(), edges.end(), cosine) - edges.begin(), kBins - 1))];
    }
    // Bins in which fewer than 20 are expected are put together.
    double chi2 = 0.0, few_expected = 0.0, few = 0.0;
    for (std::size_t i = 0; i < kBins; ++i) {
      if (expected[i] < 20.0) {
        few_expected += expected[i], few += counts[i];
        continue;
      }
      chi2 += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    }
    if (few_expected >= 20.0) chi2 += (few - few_expected) * (few - few_expected) / few_expected;
    // chi² of 63 degrees of freedom exceeds 116 once in 20 000 times; eight tests at fixed seeds.
    EXPECT_LT(chi2, 116.0) << "g " << g;
  }
}

TEST(Phase, MeanCosineIsTheAnisotropy) {
  for (const double g : {-0.9, 0.0, 0.6, 0.95}) {
    Rng rng(32, static_cast<std::uint64_t>(1000.0 * (g + 1.0)));
    Mean mean;
    for (int i = 0; i < 100'000; ++i) mean.add(sample_henyey_greenstein(g, rng.uniform()));
    const Estimate found = mean.estimate();
    EXPECT_LT(std::fabs(found.value - g), 4.0 * found.standard_error) << g;  // once in 16 000 times
  }
}

TEST(Phase, TheWholeRangeOfCosinesIsReached) {
  for (const double g : {-0.99, 0.0, 0.99}) {
    EXPECT_NEAR(sample_henyey_greenstein(g, 0.0), -1.0, 1e-10);  // cancellation of 1e-4 in the numerator at g = 0.99
    EXPECT_NEAR(sample_henyey_greenstein(g, std::nextafter(1.0, 0.0)), 1.0, 1e-10);
  }
}

TEST(Phase, ADeflectedDirectionMakesTheAngleEvenlyAround) {
  Rng rng(33);
  Mean across;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d direction = Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
    const double cosine = 2.0 * rng.uniform() - 1.0;
    const Eigen::Vector3d turned = deflect(direction, cosine, sample_disc(rng));
    ASSERT_NEAR(turned.norm(), 1.0, 1e-14);  // a few roundings
    ASSERT_NEAR(turned.dot(direction), cosine, 1e-14);
    const Eigen::Vector3d aside = direction.unitOrthogonal();
    across.add(turned.dot(aside) * turned.dot(aside) / (1.0 - cosine * cosine));
  }
  // Mean of cos² over all azimuths; 4 standard errors, once in 16 000 times.
  const Estimate found = across.estimate();
  EXPECT_LT(std::fabs(found.value - 0.5), 4.0 * found.standard_error);
}

TEST(Phase, PolesAreDeflectedToo) {
  for (const double z : {1.0, -1.0}) {
    const Eigen::Vector3d turned = deflect({0.0, 0.0, z}, 0.3, {0.6, -0.1});
    EXPECT_NEAR(turned.norm(), 1.0, 1e-15);
    EXPECT_NEAR(turned.z(), 0.3 * z, 1e-15);
  }
}

TEST(Phase, DiffuseDirectionsFollowLambert) {
  Rng rng(34);
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  Mean mean, square;
  for (int i = 0; i < 100'000; ++i) {
    const double cosine = sample_diffuse(normal, rng).dot(normal);
    ASSERT_GE(cosine, 0.0);
    mean.add(cosine), square.add(cosine * cosine);
  }
  // ∫ cos^k 2 cos d cos = 2 / (k + 2); 4 standard errors, once in 16 000 times.
  EXPECT_LT(std::fabs(mean.estimate().value - 2.0 / 3.0), 4.0 * mean.estimate().standard_error);
  EXPECT_LT(std::fabs(square.estimate().value - 0.5), 4.0 * square.estimate().standard_error);
}

}  // namespace
}  // namespace fathom
