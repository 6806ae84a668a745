#include "blind/settle.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace fathom::blind {
namespace {

constexpr double kSurely = 6.0;  // σ

bool leaves_several_open(const Answer& answer) {
  std::size_t explanations = 0;
  for (const Answer::Explanation& one : answer.ambiguity_set) explanations += one.sets.size();
  return explanations > 1;
}

bool puts_first(const Answer& answer, const Names& effects) {
  if (answer.ambiguity_set.empty()) return false;
  const std::vector<Names>& first = answer.ambiguity_set.front().sets;
  return std::find(first.begin(), first.end(), effects) != first.end();
}

std::string text(const Names& effects) { return effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, "+")); }

std::string text(const std::vector<std::pair<Names, Names>>& pairs) {
  std::string all;
  for (const auto& [first, second] : pairs)
    all += fmt::format("{}{} or {}", all.empty() ? "" : "; ", text(first), text(second));
  return all;
}

}  // namespace

std::optional<Promise> promise_of(const Answer& answer) {
  if (!leaves_several_open(answer)) return std::nullopt;
  std::optional<Promise> promise;
  for (const Answer::Proposal& next : answer.next) {
    // Of one effect in this liquid or in that the truth says nothing.
    if (next.sigma < kSurely || next.first == next.second) continue;
    if (!promise) promise = Promise{next.measurement, next.spec, next.sigma, {}};
    if (next.measurement == promise->measurement) promise->pairs.emplace_back(next.first, next.second);
  }
  return promise;
}

std::vector<Names> rivals(const Judged& one) {
  const std::optional<Promise> promise = promise_of(one.answer);
  if (!promise || one.is_unknown() || !one.truth.book_keeping.empty()) return {};
  const Names hidden = one.nameable();
  std::vector<Names> others;
  for (const auto& [first, second] : promise->pairs) {
    if (first != hidden && second != hidden) continue;
    const Names& other = first == hidden ? second : first;
    if (!std::includes(other.begin(), other.end(), hidden.begin(), hidden.end())) others.push_back(other);
  }
  return others;
}

bool is_followed_up(const Judged& one) { return one.followed && !rivals(one).empty(); }

bool is_told_apart(const Judged& one) {
  const std::vector<Names> others = rivals(one);
  return is_followed_up(one) && one.followed->holds(one.nameable()) &&
         std::none_of(others.begin(), others.end(), [&](const Names& rival) { return one.followed->holds(rival); });
}

bool is_settled(const Judged& one) { return is_told_apart(one) && puts_first(*one.followed, one.nameable()); }

Table follow_up_table(std::span<const Judged> judged) {
  Table table({"set", "class", "design", "hidden", "measurement", "sigma", "pairs", "verdict_before", "verdict_after",
               "said_first_after", "probability_after", "counts", "told_apart", "settled"});
  for (const Judged& one : judged) {
    const std::optional<Promise> promise = promise_of(one.answer);
    if (!promise || !one.followed) continue;
    const Answer& after = *one.followed;
    table.add({fmt::format("{:04}", one.truth.number), one.truth.kind, one.truth.design, one.hidden(),
               promise->measurement, fmt::format("{:.1f}", promise->sigma), text(promise->pairs), one.answer.verdict,
               after.verdict, after.ambiguity_set.empty() ? "" : text(after.ambiguity_set.front().sets.front()),
               fmt::format("{:.4f}", after.confidence()), is_followed_up(one) ? "1" : "0",
               is_told_apart(one) ? "1" : "0", is_settled(one) ? "1" : "0"});
  }
  return table;
}

}  // namespace fathom::blind
