#include "diagnosis/decision/explanations.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "diagnosis/decision/intervals.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

namespace {

std::vector<std::string> words(const Evidence& evidence, const Option& option) {
  std::vector<std::string> result;
  for (const int effect : option.effects) result.push_back(evidence.candidates[effect].effect);
  if (option.has_unknown) result.emplace_back("unknown");
  return result;
}

}  // namespace

std::vector<Explanation> explanations(const Case& c, const Posterior& posterior, const AmbiguitySet& set,
                                      const std::vector<int>& kinds) {
  const Evidence& evidence = c.evidence;
  std::vector<Explanation> result;
  for (const AmbiguityClass& one : set.classes) {
    const Option& first = one.options.front();
    Explanation explanation;
    explanation.effects = words(evidence, first);
    explanation.probability = one.probability;
    explanation.alone = one.alone;
    explanation.is_too_small = std::all_of(one.options.begin(), one.options.end(), std::mem_fn(&Option::is_too_small));
    explanation.is_liquid_open = is_one_explanation(one, kinds) && share_of_first(one) <= kSure;
    const Refit* fit = first.has_unknown || first.effects.empty() ? nullptr : find_fit(posterior.fits, first.effects);
    if (fit)
      explanation.sizes = fitted_parameters(c, with_differences(evidence, c.predict, c.covariance, c.problem, *fit));
    for (std::size_t i = 1; i < one.options.size(); ++i)
      explanation.alternatives.push_back(words(evidence, one.options[i]));
    for (const Option& superset : one.supersets) explanation.supersets.push_back(words(evidence, superset));
    result.push_back(std::move(explanation));
  }
  return result;
}

std::vector<int> kinds_of_candidates(const Evidence& evidence) {
  std::map<std::string, int> known;
  std::vector<int> kinds;
  for (const Candidate& candidate : evidence.candidates)
    kinds.push_back(known.try_emplace(effect_name(candidate.effect).id, static_cast<int>(known.size())).first->second);
  return kinds;
}

}  // namespace fathom
