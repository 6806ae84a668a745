// Which set of effects passes all tests: largest among the candidates, confirmed where it was not fitted, worse
// nowhere.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/diagnosis.h"

namespace fathom {

struct Choice {
  Refit fit;
  std::vector<NamedEffect> effects;  ///< with their evidence, without parameters
};

/// The largest that passes all tests of the likeliest set of effects, its subsets, and sets that hold it and take so
/// much more from the residual that chance does not. `fits`: likeliest first.
std::optional<Choice> choose(const Case& c, const std::vector<Refit>& fits);

/// Where no set as a whole passes: of the effects that pass in the likeliest set and that all explanations have, the
/// largest, if few of them close nearly all of the gap. What goes beside them stays open. `is_open`: even the likeliest
/// set leaves something.
std::optional<Choice> common_to_all(const Case& c, const std::vector<Refit>& fits, const std::vector<Option>& options,
                                    bool is_open);

/// The effects of a choice that may be a part of something unknown: what each changes, and no other can, is no more
/// than what something of the size that is left in a stratum has along a signature by chance.
std::vector<int> parts_of_rest(const Case& c, const Choice& choice, const Rest& rest);

/// A choice refitted without some of its effects; nothing when none is left.
std::optional<Choice> without(const Case& c, const Choice& choice, const std::vector<int>& left_out);

}  // namespace fathom
