#include "blind/judge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cctype>
#include <cmath>
#include <limits>

namespace fathom::blind {
namespace {

const Names kUnknown{"unknown"};

/// Words by which a warning is known to mean a mistake.
const std::map<std::string, std::vector<std::string>> kWords{{"label_swap", {"label", "exchang", "swap"}},
                                                             {"unit_error", {"unit", "power of ten", "centimet"}},
                                                             {"wrong_cup", {"another cup", "wrong cup", "wrong_cup"}},
                                                             {"flipped_axis", {"mirror", "flip"}},
                                                             {"duplicated_trial", {"identical", "duplicat"}}};

/// s by the answer's covariance.
double strength_by(const Answer& answer, const Truth& hidden) {
  const auto errors = answer.size_errors.find(std::string(hidden.active.effect->name));
  if (errors == answer.size_errors.end()) return hidden.strength;
  const auto error = errors->second.find(std::string(hidden.active.effect->parameter));
  if (error == errors->second.end() || !(error->second > 0.0)) return hidden.strength;
  return std::abs(hidden.active.departure) / error->second;
}

std::string joined(const Names& names) { return fmt::format("{}", fmt::join(names, "+")); }

}  // namespace

double power_of_filter(double s, int filters) {
  const boost::math::normal normal;
  return cdf(complement(normal, quantile(complement(normal, 0.01 / filters)) - s));
}

double Judged::weakest() const {
  double s = truth.effects.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Truth& hidden : truth.effects) s = std::min(s, hidden.strength);
  return s;
}

double Judged::strongest() const {
  double s = 0.0;
  for (const Truth& hidden : truth.effects) s = std::max(s, hidden.strength);
  return s;
}

double Judged::strongest_by_answer() const {
  double s = 0.0;
  for (const Truth& hidden : truth.effects) s = std::max(s, strength_by(answer, hidden));
  return s;
}

Names Judged::nameable() const {
  Names names;
  if (!is_unknown())
    for (const Truth& hidden : truth.effects) names.insert(std::string(hidden.active.effect->name));
  return names;
}

bool Judged::is_true(const Names& effects) const {
  if (is_unknown()) return effects == kUnknown;
  if (truth.aliased.empty()) return effects == nameable();
  return effects.size() == 1 &&
         std::find(truth.aliased.begin(), truth.aliased.end(), *effects.begin()) != truth.aliased.end();
}

bool Judged::is_right() const {
  if (is_unknown()) return answer.finds_unknown() && answer.named.empty();
  if (!truth.book_keeping.empty()) return finds_mistake();
  if (truth.effects.empty()) return answer.named.empty();
  if (is_true(answer.named)) return true;
  // What stands first under the verdict `none` was not found.
  return answer.verdict == "ambiguous" && answer.named.empty() && !answer.ambiguity_set.empty() &&
         is_true(answer.ambiguity_set.front().sets.front());
}

bool Judged::is_confidently_wrong() const {
  constexpr double kConfident = 0.9;
  return !is_right() && truth.book_keeping.empty() && answer.confidence() >= kConfident && !first_holds_truth();
}

bool Judged::first_holds_truth() const {
  if (answer.ambiguity_set.empty()) return false;
  const Answer::Explanation& first = answer.ambiguity_set.front();
  return first.leaves_open([&](const Names& names) { return is_true(names); }) ||
         (!nameable().empty() && first.leaves_open_together(nameable()));
}

bool Judged::holds_truth() const {
  return is_true(answer.named) ||
         std::any_of(answer.ambiguity_set.begin(), answer.ambiguity_set.end(), [&](const auto& explanation) {
           return explanation.leaves_open([&](const Names& names) { return is_true(names); });
         });
}

bool Judged::finds_mistake() const {
  if (answer.named.contains(truth.book_keeping)) return true;
  const auto words = kWords.find(truth.book_keeping);
  std::string text = answer.warnings;
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return words != kWords.end() && std::any_of(words->second.begin(), words->second.end(), [&](const std::string& word) {
           return text.find(word) != std::string::npos;
         });
}

std::string Judged::said() const {
  if (answer.named.empty()) return answer.verdict;
  return joined(answer.named) + (answer.finds_unknown() ? "+unknown" : "");
}

std::string Judged::hidden() const {
  if (!truth.book_keeping.empty()) return truth.book_keeping;
  if (truth.effects.empty()) return "none";
  Names names;
  for (const Truth& effect : truth.effects) names.insert(std::string(effect.active.effect->name));
  return joined(names) + (is_unknown() ? " (unknown)" : "");
}

}  // namespace fathom::blind
