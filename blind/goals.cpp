#include "blind/goals.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>

#include "blind/settle.h"
#include "core/estimate.h"
#include "core/proportion.h"

namespace fathom::blind {
namespace {

using Is = std::function<bool(const Judged&)>;
bool is_answered(const Judged& one) { return one.answer.verdict != "missing"; }

constexpr double kStrong = 8.0;
constexpr double kForever = std::numeric_limits<double>::infinity();

/// By its hits and trials.
void set_share(Goal& goal) {
  const Interval interval = clopper_pearson_95(goal.hits, goal.trials);
  goal.low = interval.low;
  goal.high = interval.high;
  goal.value = goal.trials > 0 ? static_cast<double>(goal.hits) / goal.trials : 0.0;
}

/// A set without an answer counts as failed.
Goal share(std::string metric, std::span<const Judged> judged, const Is& counts, const Is& hits, Want want, double bar,
           double bar_high = 0.0) {
  Goal goal{.metric = std::move(metric), .want = want, .bar = bar, .bar_high = bar_high};
  for (const Judged& one : judged) {
    if (!counts(one)) continue;
    ++goal.trials;
    goal.hits += is_answered(one) ? hits(one) : want == Want::at_most;
  }
  set_share(goal);
  return goal;
}

Goal mean(std::string metric, std::span<const Judged> judged, const Is& counts,
          const std::function<double(const Judged&)>& value, Want want, double bar) {
  Goal goal{.metric = std::move(metric), .low = -kForever, .high = kForever, .want = want, .bar = bar};
  Mean values;
  for (const Judged& one : judged)
    if (counts(one)) values.add(value(one));
  goal.trials = static_cast<int>(values.count());
  if (goal.trials < 2) {
    goal.trials = 0;  // no interval from one
    return goal;
  }
  const Estimate estimate = values.estimate();
  goal.value = estimate.value;
  goal.low = estimate.value - 2.0 * estimate.standard_error;
  goal.high = estimate.value + 2.0 * estimate.standard_error;
  return goal;
}

bool has_gap(const Judged& one) { return one.answer.noise_floor > 0.0; }
double behind_filter(const Judged& one) { return power_of_filter(one.strongest()) - one.answer.detects_something(); }
double behind_by_answer(const Judged& one) {
  return power_of_filter(one.strongest_by_answer()) - one.answer.detects_something();
}
double behind_bank(const Judged& one) {
  return power_of_filter(one.strongest_by_answer(), kBank) - one.answer.detects_something();
}

Is of_kind(const std::string& kind, double from = 0.0, double to = kForever) {
  return [=](const Judged& one) {
    return one.truth.kind == kind && !one.truth.effects.empty() && one.weakest() >= from && one.weakest() < to;
  };
}

bool is_null(const Judged& one) { return one.truth.effects.empty() && one.truth.book_keeping.empty(); }
bool is_plain(const Judged& one) { return one.truth.noise_scale == 1.0 && !one.truth.heavy_tails; }
bool has_effects(const Judged& one) {
  return one.truth.kind == "single" || one.truth.kind == "pair" || one.truth.kind == "triple";
}
bool is_right(const Judged& one) { return one.is_right(); }

Is escaping(double from, double to = kForever) {
  return [=](const Judged& one) { return one.is_unknown() && one.truth.escape >= from && one.truth.escape < to; };
}

bool calls_aliased_ambiguous(const Judged& one) {
  for (const std::string& twin : one.truth.aliased)
    if (!one.answer.holds({twin})) return false;
  return one.answer.verdict == "ambiguous" || one.answer.ambiguity_set.size() > 1 ||
         (one.answer.ambiguity_set.size() == 1 && one.answer.ambiguity_set[0].sets.size() > 1);
}

/// Share of the gap above the noise floor that was closed.
double gap_closed(const Judged& one) {
  const double before = std::pow(one.answer.before_rms, 2), after = std::pow(one.answer.after_rms, 2),
               floor = std::pow(one.answer.noise_floor, 2);
  return before > floor ? (before - after) / (before - floor) : 1.0;
}

/// Over the effects that were rightly named and whose parameter was given.
Goal coverage(std::span<const Judged> judged) {
  Goal goal{.metric = "parameter within its 95 % interval", .want = Want::between, .bar = 0.93, .bar_high = 0.97};
  for (const Judged& one : judged) {
    if (!has_effects(one) || one.answer.named != one.nameable()) continue;
    for (const Truth& hidden : one.truth.effects) {
      const Hidden& effect = *hidden.active.effect;
      const auto named = one.answer.parameters.find(std::string(effect.name));
      if (named == one.answer.parameters.end()) continue;
      const auto estimate = named->second.find(std::string(effect.parameter));
      if (estimate == named->second.end()) continue;
      const double value = effect.nominal + hidden.active.departure;
      ++goal.trials;
      goal.hits += value >= estimate->second.low && value <= estimate->second.high;
    }
  }
  set_share(goal);
  return goal;
}

/// F1 over liquids, in which an effect of s ≥ 5 shows by 3 at least; a stratum that names none is of all.
Goal localisation(std::span<const Judged> judged) {
  constexpr double kShows = 3.0, kJudged = 5.0;
  Goal goal{.metric = "localisation F1 over liquids", .low = 0.0, .high = 1.0, .bar = 0.85};
  int right = 0, wrong = 0, missed = 0;
  for (const Judged& one : judged) {
    if (!has_effects(one) || one.strongest() < kJudged) continue;
    ++goal.trials;
    for (const auto& [liquid, s] : one.truth.strength_by_liquid) {
      const bool found = one.answer.gap_in_all_liquids || one.answer.liquids_in_gap.contains(liquid);
      if (s >= kShows) (found ? right : missed) += 1;
      if (s < kShows && found) ++wrong;
    }
  }
  goal.hits = right;
  goal.value = right > 0 ? 2.0 * right / (2.0 * right + wrong + missed) : 0.0;
  goal.low = goal.high = goal.value;
  return goal;
}

}  // namespace

std::string Goal::verdict() const {
  if (trials == 0) return "no sets";
  if (want == Want::between) {
    if (low >= bar && high <= bar_high) return "met";
    return value >= bar && value <= bar_high ? "open" : "missed";
  }
  const bool least = want == Want::at_least;
  if (least ? low >= bar : high <= bar) return "met";
  return (least ? value >= bar : value <= bar) ? "open" : "missed";
}

std::vector<Goal> goals_of(std::span<const Judged> judged) {
  const auto names = [](const Judged& one) { return one.answer.names_something(); };
  const auto flags = [](const Judged& one) { return one.answer.finds_unknown(); };
  const auto plain_null = [](const Judged& one) { return is_null(one) && is_plain(one); };
  const auto odd_null = [](const Judged& one) { return is_null(one) && !is_plain(one); };
  const auto strong_single = of_kind("single", kStrong);
  const auto strong_and_answered = [=](const Judged& one) { return strong_single(one) && is_answered(one); };
  const auto strong_with_gap = [=](const Judged& one) { return strong_single(one) && has_gap(one); };
  const auto judged_at_all = [](const Judged& one) { return one.truth.book_keeping.empty(); };
  std::vector<Goal> goals{
      share(
          "answered", judged, [](const Judged&) { return true; }, is_answered, Want::at_least, 1.0),
      share(
          "null set called none", judged, is_null, [](const Judged& one) { return one.answer.verdict == "none"; },
          Want::at_least, 0.95),
      share("names something on a null set", judged, plain_null, names, Want::at_most, 0.01),
      share("… whose noise is mis-scaled or heavy-tailed", judged, odd_null, names, Want::at_most, 0.02),
      share("calls a null set unknown", judged, is_null, flags, Want::at_most, 0.01),
      share("single effect first, s 5 to 8", judged, of_kind("single", 5.0, kStrong), is_right, Want::at_least, 0.90),
      share("single effect first, s ≥ 8", judged, strong_single, is_right, Want::at_least, 0.97),
      share(
          "truth in the ambiguity set", judged, has_effects, [](const Judged& one) { return one.holds_truth(); },
          Want::at_least, 0.99),
      mean(
          "mean size of the ambiguity set, s ≥ 8", judged, strong_and_answered,
          [](const Judged& one) { return static_cast<double>(one.answer.ambiguity_set.size()); }, Want::at_most, 1.5),
      share("aliased effects called ambiguous", judged, of_kind("aliased"), calls_aliased_ambiguous, Want::at_least,
            1.0),
      share("pair exact, both s ≥ 8", judged, of_kind("pair", kStrong), is_right, Want::at_least, 0.90),
      share("triple exact", judged, of_kind("triple"), is_right, Want::at_least, 0.75),
      share("unknown flagged, escape ≥ 10", judged, escaping(10.0), flags, Want::at_least, 0.97),
      share("unknown flagged, escape 8 to 10", judged, escaping(8.0, 10.0), flags, Want::at_least, 0.84),
      share("unknown flagged, escape 6 to 8", judged, escaping(6.0, 8.0), flags, Want::at_least, 0.50),
      share(
          "confidently wrong", judged, judged_at_all, [](const Judged& one) { return one.is_confidently_wrong(); },
          Want::at_most, 0.02),
      share(
          "confidently wrong, escape ≥ 8", judged, escaping(8.0),
          [](const Judged& one) { return one.is_confidently_wrong(); }, Want::at_most, 0.01),
      share(
          "book-keeping found", judged, [](const Judged& one) { return !one.truth.book_keeping.empty(); }, is_right,
          Want::at_least, 0.95),
      mean("gap closed on held-out conditions, s ≥ 8", judged, strong_with_gap, gap_closed, Want::at_least, 0.95),
      mean(
          "held-out RMS over noise floor, s ≥ 8", judged, strong_with_gap,
          [](const Judged& one) { return one.answer.after_rms / one.answer.noise_floor; }, Want::at_most, 1.05),
      coverage(judged),
      localisation(judged),
      share("settled by what was proposed at 6 σ", judged, is_followed_up, is_settled, Want::at_least, 0.90),
      mean(
          "matched filter's power less detected share", judged, [](const Judged& one) { return one.is_single(); },
          behind_filter, Want::at_most, 0.10),
      mean(
          "matched filter with the diagnosis's covariance: power less detected share", judged,
          [](const Judged& one) { return one.is_single(); }, behind_by_answer, Want::at_most, 0.10),
      mean(
          "a bank of such filters, one for each effect and sign: power less detected share", judged,
          [](const Judged& one) { return one.is_single(); }, behind_bank, Want::at_most, 0.10),
  };
  return goals;
}

Table table_of(std::span<const Goal> goals) {
  Table table({"metric", "value", "low95", "high95", "hits", "trials", "bar", "verdict"});
  for (const Goal& goal : goals) {
    const char* sign = goal.want == Want::at_least ? "≥ " : goal.want == Want::at_most ? "≤ " : "";
    const std::string bar = goal.want == Want::between ? fmt::format("{:g} to {:g}", goal.bar, goal.bar_high)
                                                       : fmt::format("{}{:g}", sign, goal.bar);
    const auto number = [&](double x) { return goal.trials > 0 && std::isfinite(x) ? fmt::format("{:.4f}", x) : ""; };
    table.add({goal.metric, number(goal.value), number(goal.low), number(goal.high), fmt::format("{}", goal.hits),
               fmt::format("{}", goal.trials), bar, goal.verdict()});
  }
  return table;
}

}  // namespace fathom::blind
