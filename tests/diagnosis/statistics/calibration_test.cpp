// Simulation-based calibration (Talts et al. 2018): on campaigns that are drawn from the prior, what the posterior says
// with a probability holds as often, and the truth's rank in the posterior of a size is uniform.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.h"
#include "diagnosis/decision/decide.h"
#include "diagnosis/statistics/distributions.h"
#include "tests/diagnosis/statistics/small_campaign.h"

namespace fathom {
namespace {

constexpr int kCampaigns = 80;

/// With even odds nothing, or an effect of a normal size three typical departures wide.
std::vector<EffectValue> drawn(const World& world, std::uint64_t seed) {
  Rng rng(seed, 90);
  if (rng.uniform() < 0.5) return {};
  const auto& candidates = world.nominal().candidates;
  const Candidate& candidate = candidates[rng.below(static_cast<std::uint32_t>(candidates.size()))];
  const double size = 3.0 * rng.normal();
  return {{candidate.effect, {candidate.parameters[0].lower < 0.0 ? size : std::abs(size)}}};
}

bool holds(const Explanation& explanation, const std::vector<EffectValue>& truth) {
  std::vector<std::string> names;
  for (const EffectValue& value : truth) names.push_back(value.effect);
  return explanation.effects == names || std::find(explanation.alternatives.begin(), explanation.alternatives.end(),
                                                   names) != explanation.alternatives.end();
}

TEST(Calibration, OfProbabilitiesAndSizes) {
  const World world(small_design());
  double said = 0.0, variance = 0.0, held = 0.0;
  std::array<int, 4> ranks{};
  int sizes = 0;
  for (std::uint64_t seed = 1; seed <= kCampaigns; ++seed) {
    const std::vector<EffectValue> truth = drawn(world, seed);
    const Diagnosis diagnosis = decide(world.measure(truth, {}, 5000 + seed), world.predict());
    const Explanation& first = diagnosis.ambiguity_set.at(0);
    said += first.alone;
    variance += first.alone * (1.0 - first.alone);
    held += holds(first, truth);
    if (truth.empty() || diagnosis.effects.size() != 1 || diagnosis.effects[0].name != truth[0].effect) continue;
    const NamedParameter& named = diagnosis.effects[0].parameters[0];
    const double sd = (named.high95 - named.value) / 1.96;
    const double rank = 1.0 - normal_tail((truth[0].values[0] - named.value) / sd);
    ++ranks[static_cast<std::size_t>(std::min(3.0, 4.0 * rank))];
    ++sizes;
  }
  // Three standard deviations: 1 in 370 by chance, for good models.
  EXPECT_NEAR(held, said, 3.0 * std::sqrt(variance) + 1.0);
  ASSERT_GE(sizes, kCampaigns / 5);
  double chi2 = 0.0;
  for (const int count : ranks) chi2 += std::pow(count - sizes / 4.0, 2.0) / (sizes / 4.0);
  EXPECT_GT(chi_squared_tail(chi2, 3.0), 0.003) << ranks[0] << " " << ranks[1] << " " << ranks[2] << " " << ranks[3];
}

}  // namespace
}  // namespace fathom
