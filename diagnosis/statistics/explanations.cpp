#include "diagnosis/statistics/explanations.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "diagnosis/statistics/effect_name.h"

namespace fathom {

namespace {

std::vector<std::string> words(const Evidence& evidence, const Option& option) {
  std::vector<std::string> result;
  for (const int effect : option.effects) result.push_back(evidence.candidates[effect].effect);
  if (option.has_unknown) result.emplace_back("unknown");
  return result;
}

std::set<std::string> ids(const Evidence& evidence, const Option& option) {
  std::set<std::string> result;
  for (const std::string& word : words(evidence, option)) result.insert(effect_name(word).id);
  return result;
}

/// Of the first class in which some option is such.
template <class Is>
double probability_where(const AmbiguitySet& set, const Is& is) {
  const auto found = std::find_if(set.classes.begin(), set.classes.end(), [&](const AmbiguityClass& one) {
    return std::any_of(one.options.begin(), one.options.end(), is);
  });
  return found != set.classes.end() ? found->probability : 0.0;
}

}  // namespace

std::vector<Explanation> explanations(const Evidence& evidence, const AmbiguitySet& set) {
  std::vector<Explanation> result;
  for (const AmbiguityClass& one : set.classes) {
    Explanation explanation{words(evidence, one.options.front()),
                            {},
                            {},
                            one.probability,
                            one.alone,
                            std::all_of(one.options.begin(), one.options.end(), std::mem_fn(&Option::is_too_small))};
    for (std::size_t i = 1; i < one.options.size(); ++i)
      explanation.alternatives.push_back(words(evidence, one.options[i]));
    for (const Option& superset : one.supersets) explanation.supersets.push_back(words(evidence, superset));
    result.push_back(std::move(explanation));
  }
  return result;
}

bool all_name(const Evidence& evidence, const std::vector<int>& effects, const AmbiguitySet& set) {
  const std::set<std::string> named = ids(evidence, {effects, {}, false, 0.0, {}});
  return std::all_of(set.classes.begin(), set.classes.end(), [&](const AmbiguityClass& one) {
    return std::all_of(one.options.begin(), one.options.end(),
                       [&](const Option& o) { return ids(evidence, o) == named; });
  });
}

std::vector<int> kinds_of_candidates(const Evidence& evidence) {
  std::map<std::string, int> known;
  std::vector<int> kinds;
  for (const Candidate& candidate : evidence.candidates)
    kinds.push_back(known.try_emplace(effect_name(candidate.effect).id, static_cast<int>(known.size())).first->second);
  return kinds;
}

double probability_of_nothing(const AmbiguitySet& set) {
  return probability_where(set, std::mem_fn(&Option::is_nothing));
}

double probability_of_unknown(const AmbiguitySet& set) {
  return probability_where(set, std::mem_fn(&Option::is_unknown_alone));
}

}  // namespace fathom
