// Whether the measurement that an ambiguous answer proposes settles what it was proposed for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blind/judge.h"
#include "core/table.h"

namespace fathom::blind {

/// Of an answer that leaves several explanations open: the first measurement of which it says that it tells two of them
/// apart by 6 σ, with all the pairs of which it says so.
struct Promise {
  std::string measurement, spec;
  double sigma;  ///< of the first pair
  std::vector<std::pair<Names, Names>> pairs;
};
std::optional<Promise> promise_of(const Answer& answer);

/// What the measurement must exclude: the other explanation of each of its pairs in which one is exactly what is
/// hidden. None where that is unknown or a mistake of book-keeping. Explanations that hold all that is hidden and
/// something more are left out: no measurement excludes them, as that something may be nil.
std::vector<Names> rivals(const Judged& one);

/// The measurement was made, and there is something that it must exclude.
bool is_followed_up(const Judged& one);

/// The answer to the set and that measurement together has exactly what is hidden among its explanations still, and
/// none of the rivals any more, however improbable.
bool is_told_apart(const Judged& one);

/// That answer also puts first what is hidden, or what cannot be told from it.
bool is_settled(const Judged& one);

/// One line for each set that was followed up: what was proposed, for which pairs, and what came of it.
Table follow_up_table(std::span<const Judged> judged);

}  // namespace fathom::blind
