#include "diagnosis/ray_traced/tracing_plan.h"

#include <algorithm>
#include <utility>

#include "diagnosis/statistics/evidence.h"
#include "sim/sensor/capture.h"

namespace fathom {
namespace {

constexpr double kMost_s = 170.0;      // of processor time
constexpr std::size_t kLikeliest = 4;  // explanations that are traced

using Set = std::vector<std::string>;

Set named_set(const Diagnosis& diagnosis) {
  Set set;
  for (const NamedEffect& effect : diagnosis.effects) set.push_back(effect.name);
  return set;
}

bool is_unseen(const Candidate& candidate) { return candidate.sensitivity.isZero(0.0); }

/// Whether few rays see something of a set.
bool sees_some(const Evidence& evidence, const Set& set) {
  return std::any_of(evidence.candidates.begin(), evidence.candidates.end(), [&](const Candidate& candidate) {
    return !is_unseen(candidate) && std::find(set.begin(), set.end(), candidate.effect) != set.end();
  });
}

/// Each effect of light in all liquids. Images have all light or none, so the first that few rays do not see at all
/// stands for all of those.
std::vector<Set> light_sets(const Physics& physics) {
  std::vector<Set> sets;
  bool has_unseen = false;
  for (const Candidate& candidate : physics.evidence.candidates) {
    if (!effect_name(candidate.effect).liquid.empty() || !brings_light(*physics.predictor, candidate)) continue;
    if (is_unseen(candidate) && std::exchange(has_unseen, true)) continue;
    sets.push_back({candidate.effect});
  }
  return sets;
}

std::vector<Set> all_sets(const Physics& physics, const Diagnosis& diagnosis) {
  std::vector<Set> sets{named_set(diagnosis)};
  for (Set& set : light_sets(physics)) sets.push_back(std::move(set));
  for (std::size_t i = 0; i < std::min(kLikeliest, diagnosis.ambiguity_set.size()); ++i)
    if (sees_some(physics.evidence, diagnosis.ambiguity_set[i].effects))
      sets.push_back(diagnosis.ambiguity_set[i].effects);
  std::vector<Set> different;
  for (Set& set : sets) {
    std::erase(set, "unknown");
    if (!set.empty() && std::find(different.begin(), different.end(), set) == different.end())
      different.push_back(std::move(set));
  }
  return different;
}

}  // namespace

TracingPlan plan_tracing(const Physics& physics, const Diagnosis& diagnosis, const RayTracer& tracer) {
  TracingPlan plan;
  RayTracer::Cost total = tracer.cost({});
  for (Set& set : all_sets(physics, diagnosis)) {
    std::vector<EffectValue> typical;
    std::size_t predictions = 1;
    for (const Candidate& candidate : physics.evidence.candidates) {
      if (std::find(set.begin(), set.end(), candidate.effect) == set.end()) continue;
      typical.push_back(typical_departure(candidate));
      if (!is_unseen(candidate)) predictions += 1 + 2 * candidate.parameters.size();  // nearer to the fit, and slopes
    }
    const RayTracer::Cost once = tracer.cost(typical);
    const double seconds = static_cast<double>(predictions) * once.seconds;
    if (set != named_set(diagnosis) && total.seconds + seconds > kMost_s) {
      ++plan.left_out;
      continue;
    }
    total.seconds += seconds;
    total.conditions += predictions * once.conditions;
    plan.sets.push_back(std::move(set));
  }
  plan.conditions = total.conditions;
  return plan;
}

}  // namespace fathom
