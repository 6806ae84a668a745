// One answer beside its truth.
#pragma once

#include <optional>

#include "blind/draw.h"
#include "blind/report_file.h"

namespace fathom::blind {

/// How often a filter that knows an effect of strength s finds it, at 1 % false alarms of all `filters` that are run on
/// the same measurement (Bonferroni), each one-sided.
double power_of_filter(double s, int filters = 1);
constexpr int kBank = 2 * 38;  ///< a filter for each effect of the registry and either sign

struct Judged {
  SetTruth truth;
  Answer answer;
  std::optional<Answer> followed = {};  ///< to the set and what the answer proposed to measure next, together

  double weakest() const;    ///< smallest s of what is hidden; 0 of nothing
  double strongest() const;  ///< largest
  /// The largest s by the answer's covariance: what is hidden beside the error that the answer has for its size. The
  /// set's own s where the answer does not have the parameter whose truth is written down.
  double strongest_by_answer() const;
  /// The effects that a registry can name; empty where there are none or where they are unknown.
  Names nameable() const;
  bool is_unknown() const { return truth.kind == "unknown" && !truth.effects.empty(); }
  bool is_single() const { return truth.kind == "single" && !truth.effects.empty(); }
  /// What it puts first or names is exactly what is hidden, or, of aliased ones, one of them.
  bool is_right() const;
  /// Whether these effects are exactly what is hidden, or, of aliased ones, one of them.
  bool is_true(const Names& effects) const;
  /// What is hidden is among the sets of effects that its first explanation leaves open: that explanation itself, what
  /// cannot be told from it, and what may be there as well, one effect more or several of these together.
  bool first_holds_truth() const;
  /// Neither is it right nor does its first hold the truth, and that has a probability of at least 0.9.
  bool is_confidently_wrong() const;
  /// What is hidden is among its explanations.
  bool holds_truth() const;
  /// Of book-keeping: a warning or an effect says what went wrong.
  bool finds_mistake() const;
  /// What it says, in one word or some: effects joined by +, "none", "unknown", …
  std::string said() const;
  std::string hidden() const;
};

}  // namespace fathom::blind
