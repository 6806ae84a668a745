// The explanations that are weighed against each other, each with its log posterior.
#pragma once

#include <cmath>
#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/case.h"

namespace fathom {

/// That something is there which no list holds.
inline const double kLogPriorUnknown = std::log(0.1);

/// Sets of effects by their signatures alone, likeliest first.
std::vector<Hypothesis> screened(const Case& c);

/// The likeliest sets, fitted with the model itself; the empty one among them, likeliest first.
std::vector<Refit> likeliest_fits(const Case& c, const std::vector<Hypothesis>& hypotheses);

/// Those fits, alone and beside something unknown, and what was not worth a fit but cannot be excluded.
std::vector<Option> options_of(const Case& c, const std::vector<Hypothesis>& hypotheses,
                               const std::vector<Refit>& fits);

/// The same beside what no list holds: several effects together may imitate it, the better the more they are. Of
/// what bench/blind hides, what the list lacks looks like some two effects a sixth as often as two are hidden, and
/// with each more eight times as often; effects beside something unknown are always open to be a part of it. What
/// `is_tested`, the likeliest, and passed stays before it.
std::vector<Option> with_imitated(std::vector<Option> options, bool is_tested);

}  // namespace fathom
