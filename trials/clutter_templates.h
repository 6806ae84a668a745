// Templates of the cups that stand on random desks, made as a laboratory makes them: each captured once, empty.
#pragma once

#include <vector>

#include "detector/cup_template.h"
#include "sim/scene/clutter.h"

namespace fathom {

/// Of each kind of cup, seen alone in the middle of the region's near side, where the most of its bottom is seen, by
/// the same sensor without noise. Kinds that the paper's gates do not take for cups (clear glass, tall mugs) have none.
std::vector<CupTemplate> templates_of(const ClutterSpec& clutter);

}  // namespace fathom
