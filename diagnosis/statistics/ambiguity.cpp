#include "diagnosis/statistics/ambiguity.h"

#include <algorithm>
#include <cmath>

namespace fathom {

namespace {

constexpr double kAlike = 1.0;  // whitened distance of predictions

bool are_twins(const Option& a, const Option& b) {
  return a.has_unknown == b.has_unknown && a.effects.size() == b.effects.size() &&
         (a.prediction - b.prediction).norm() < kAlike;
}

bool includes(const Option& larger, const Option& smaller) {
  const bool is_something = smaller.has_unknown || !smaller.effects.empty();
  return is_something && larger.has_unknown >= smaller.has_unknown &&
         larger.effects.size() + larger.has_unknown > smaller.effects.size() + smaller.has_unknown &&
         std::includes(larger.effects.begin(), larger.effects.end(), smaller.effects.begin(), smaller.effects.end());
}

}  // namespace

AmbiguitySet ambiguity_set(std::vector<Option> options, double delta) {
  std::stable_sort(options.begin(), options.end(),
                   [](const Option& a, const Option& b) { return a.log_posterior > b.log_posterior; });
  AmbiguitySet set;
  const double best = options.front().log_posterior;
  for (Option& option : options) {
    const double weight = std::exp(option.log_posterior - best);
    const auto home = std::find_if(set.classes.begin(), set.classes.end(), [&](const std::vector<Option>& known) {
      return are_twins(known.front(), option) ||
             std::any_of(known.begin(), known.end(), [&](const Option& one) { return includes(option, one); });
    });
    if (home != set.classes.end()) {
      set.probabilities[home - set.classes.begin()] += weight;
      if (are_twins(home->front(), option)) home->push_back(std::move(option));
    } else if (option.log_posterior > best - delta) {
      set.classes.push_back({std::move(option)});
      set.probabilities.push_back(weight);
    }
  }
  // What lies outside the set is spread over it: together less than the δ allows.
  double inside = 0.0;
  for (const double probability : set.probabilities) inside += probability;
  for (double& probability : set.probabilities) probability /= inside;
  return set;
}

}  // namespace fathom
