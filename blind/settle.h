// Whether the measurement that an ambiguous answer proposes settles what it was proposed for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blind/judge.h"
#include "core/table.h"

namespace fathom::blind {

/// The first measurement that is said to tell two explanations apart by 6 σ, of an answer that leaves several open.
/// It says so of every pair that it tells apart by as much.
struct Promise {
  std::string measurement, spec;
  double sigma;  ///< of the first pair
  std::vector<std::pair<Names, Names>> pairs;
};
std::optional<Promise> promise_of(const Answer& answer);

/// What the promise says to tell from what is hidden: none where that is in no pair, as what is unknown always is. No
/// measurement excludes what holds all that is hidden and more, which may be nil, and none is promised to.
std::vector<Names> rivals(const Judged& one);

/// It was followed up, and what is hidden was among the pairs: there is something to settle.
bool is_followed_up(const Judged& one);

/// By the set and the further measurement together what is hidden, exactly, is an explanation still, and none of its
/// rivals is one any more, however improbable.
bool is_told_apart(const Judged& one);

/// Beyond that what is hidden is what is put first, or cannot be told from it.
bool is_settled(const Judged& one);

/// One line for each set that was followed up: what was proposed, for which pairs, and what came of it.
Table follow_up_table(std::span<const Judged> judged);

}  // namespace fathom::blind
