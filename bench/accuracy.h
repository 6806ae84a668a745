// The parts of accuracy_sensor: each shoots its scenes and prints its rows.
#pragma once

namespace fathom {

void compare_desks();      ///< noise of a desk, with the same estimators on measured clouds
void compare_pots();       ///< mean height of an empty pot's floor, from scene to scene
void compare_ranges();     ///< axial noise over distance, border, valid share
void compare_edges();      ///< shadows, noise of an edge
void compare_times();      ///< temporal noise, warming up, units
void compare_materials();  ///< milky plastic, a black glossy mug

}  // namespace fathom
