#include "diagnosis/statistics/ambiguity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace fathom {

namespace {

constexpr double kAlike = 1.0;          // whitened distance of predictions
constexpr double kPlausible = 3.0;      // log odds against an effect beside others, to be listed
constexpr double kWorthListing = 0.05;  // of all probability, for what adds to an explanation

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
  std::vector<AmbiguityClass> own, added;  // a class and what adds to it have the same number
  const double best = options.front().log_posterior;
  const auto join = [&](AmbiguityClass& home, Option& option) {
    home.probability += std::exp(option.log_posterior - best);
    home.options.push_back(std::move(option));
  };
  for (Option& option : options) {
    const auto home = [&](const auto& is_of) {
      return std::find_if(own.begin(), own.end(), [&](const AmbiguityClass& known) { return is_of(known.options); }) -
             own.begin();
    };
    const auto twins = static_cast<std::size_t>(
        home([&](const std::vector<Option>& known) { return are_twins(known.front(), option); }));
    const auto part = static_cast<std::size_t>(home([&](const std::vector<Option>& known) {
      return std::any_of(known.begin(), known.end(), [&](const Option& one) { return includes(option, one); });
    }));
    if (twins < own.size()) {
      join(own[twins], option);
    } else if (part < own.size()) {
      AmbiguityClass& more = added[part];
      const bool is_plausible = option.log_posterior > own[part].options.front().log_posterior - kPlausible;
      more.probability += std::exp(option.log_posterior - best);
      if (is_plausible || more.options.empty()) more.options.push_back(std::move(option));
    } else if (option.log_posterior > best - delta) {
      own.emplace_back();
      added.push_back({{}, 0.0, true});
      join(own.back(), option);
    }
  }
  double sum = 0.0;
  for (const auto* classes : {&own, &added})
    for (const AmbiguityClass& one : *classes) sum += one.probability;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (added[k].probability < kWorthListing * sum) own[k].probability += std::exchange(added[k].probability, 0.0);
  std::erase_if(added, [](const AmbiguityClass& one) { return one.probability == 0.0; });
  AmbiguitySet set{std::move(own)};
  set.classes.insert(set.classes.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
  // What lies outside the set is spread over it.
  double inside = 0.0;
  for (const AmbiguityClass& one : set.classes) inside += one.probability;
  for (AmbiguityClass& one : set.classes) one.probability /= inside;
  return set;
}

}  // namespace fathom
