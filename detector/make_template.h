// Templates of cups from captured scenes.
#pragma once

#include <optional>
#include <string>

#include "detector/cup_template.h"
#include "detector/desk_view.h"

namespace fathom {

/// Makes a template of an empty cup. The view gives the points of the bottom, which the segment has not; `candidate`
/// must have a circle. `liquid_threshold_m`: nothing = 2 mm above the bottom that is seen (the paper's 9 mm for its
/// cup); throws Error when none is seen.
CupTemplate make_template(std::string name, const DeskView& view, const CupCandidate& candidate,
                          const InteriorSettings& interior, std::optional<double> liquid_threshold_m);

/// Of the one cup that stands on the desk. Throws Error, naming `source`, where there is no desk, or more or fewer cups
/// than one.
CupTemplate template_of_only_cup(std::string name, const Cloud& cloud, const std::optional<DeskPrior>& prior,
                                 std::optional<double> liquid_threshold_m, const std::string& source);

}  // namespace fathom
