// The goals of the blind tests, as counts with their intervals.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "blind/judge.h"
#include "core/table.h"

namespace fathom::blind {

enum class Want { at_least, at_most, between };

struct Goal {
  std::string metric{};
  double value = 0.0;
  double low = 0.0, high = 1.0;  ///< 95 % interval; of means, of ± 2 standard errors
  int hits = 0, trials = 0;      ///< hits: of shares only
  Want want = Want::at_least;
  double bar = 0.0, bar_high = 0.0;

  /// "met": the interval is on the bar's right side; "open": the value is; "missed"; "no sets".
  std::string verdict() const;
};

std::vector<Goal> goals_of(std::span<const Judged> judged);

/// metric, value, low95, high95, hits, trials, bar, verdict
Table table_of(std::span<const Goal> goals);

}  // namespace fathom::blind
