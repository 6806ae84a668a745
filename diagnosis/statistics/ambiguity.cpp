#include "diagnosis/statistics/ambiguity.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fathom {

namespace {

constexpr double kAlike = 1.0;  // whitened distance of predictions

bool are_twins(const Option& a, const Option& b) {
  return a.has_unknown == b.has_unknown && a.effects.size() == b.effects.size() &&
         (a.prediction - b.prediction).norm() < kAlike;
}

}  // namespace

bool Option::is_too_small() const { return !effects.empty() && !has_unknown && prediction.norm() < kAlike; }

const Option& likeliest(const std::vector<Option>& options) {
  return *std::max_element(options.begin(), options.end(),
                           [](const Option& a, const Option& b) { return a.log_posterior < b.log_posterior; });
}

std::set<int> kinds_of(const Option& option, const std::vector<int>& kinds) {
  std::set<int> result;
  for (const int effect : option.effects) result.insert(kinds[effect]);
  return result;
}

void AmbiguitySet::put_unknown_first() {
  std::stable_partition(classes.begin(), classes.end(),
                        [](const AmbiguityClass& one) { return one.options.front().has_unknown; });
}

bool is_one_explanation(const AmbiguityClass& one, const std::vector<int>& kinds) {
  return std::ranges::all_of(one.options, [&](const Option& option) {
    return kinds_of(option, kinds) == kinds_of(one.options.front(), kinds);
  });
}

double share_of_first(const AmbiguityClass& one) {
  double all = 0.0;
  for (const Option& option : one.options) all += std::exp(option.log_posterior - one.options.front().log_posterior);
  return 1.0 / all;
}

AmbiguitySet ambiguity_set(std::vector<Option> options, const std::vector<int>& kinds, double delta,
                           double doubt_of_unknown) {
  const double best = likeliest(options).log_posterior;
  const auto rank = [&](const Option& option) {
    return option.log_posterior - (option.has_unknown ? doubt_of_unknown : 0.0);
  };
  std::stable_sort(options.begin(), options.end(), [&](const Option& a, const Option& b) { return rank(a) > rank(b); });
  AmbiguitySet set;
  double sum = 0.0;
  for (Option& option : options) {
    if (option.log_posterior <= best - delta) continue;
    const std::set<int> own = kinds_of(option, kinds);
    const auto belongs = [&](const auto& is_akin) {
      return std::find_if(set.classes.begin(), set.classes.end(), [&](const AmbiguityClass& one) {
        return std::any_of(one.options.begin(), one.options.end(), is_akin);
      });
    };
    const auto is_same = [&](const Option& known) {
      return known.has_unknown == option.has_unknown && kinds_of(known, kinds) == own;
    };
    const auto is_superset = [&](const Option& known) {
      const std::set<int> less = kinds_of(known, kinds);
      return (known.has_unknown || !less.empty()) && option.has_unknown >= known.has_unknown &&
             std::includes(own.begin(), own.end(), less.begin(), less.end());
    };
    auto home = belongs(is_same);
    const bool adds = home == set.classes.end() && (home = belongs(is_superset)) != set.classes.end();
    if (home == set.classes.end()) home = belongs([&](const Option& known) { return are_twins(known, option); });
    AmbiguityClass& one = home != set.classes.end() ? *home : set.classes.emplace_back();
    const double weight = std::exp(option.log_posterior - best);
    sum += weight;
    one.probability += weight;
    if (!adds) one.alone += weight;
    (adds ? one.supersets : one.options).push_back(std::move(option));
  }
  for (AmbiguityClass& one : set.classes) {
    one.probability /= sum;
    one.alone /= sum;
  }
  std::stable_sort(set.classes.begin(), set.classes.end(),
                   [](const AmbiguityClass& a, const AmbiguityClass& b) { return a.probability > b.probability; });
  return set;
}

}  // namespace fathom
