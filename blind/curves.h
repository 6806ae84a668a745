// What the goals do not show: power against strength, who is taken for whom, whether probabilities are true, what
// refusing to answer buys, and the worst cases.
#pragma once

#include <span>

#include "blind/judge.h"
#include "core/table.h"

namespace fathom::blind {

/// By bins of s, over single effects: detected and rightly named shares with their intervals, and the power of a filter
/// that knows the sensitivity (power_of_filter).
Table power_table(std::span<const Judged> judged);

/// hidden, said, sets
Table confusion_table(std::span<const Judged> judged);

/// By bins of the probability of what is put first: how often what is hidden is there (first_holds_truth).
Table reliability_table(std::span<const Judged> judged);

/// Answers by falling confidence: the share that is given, and that of wrong ones among them.
Table risk_coverage_table(std::span<const Judged> judged);

/// Wrong answers, the most confident first, then the strongest effects.
Table worst_table(std::span<const Judged> judged);

/// One line a set: class, design, hidden, s, escape, said, probability, right.
Table sets_table(std::span<const Judged> judged);

}  // namespace fathom::blind
