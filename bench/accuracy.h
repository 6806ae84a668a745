// The parts of accuracy_sensor: each shoots its scenes and prints its rows.
#pragma once

#include "sim/sensor/capture.h"

namespace fathom {

void compare_desks(CaptureMode mode);   ///< noise of a desk, with the same estimators on measured clouds
void compare_pots(CaptureMode mode);    ///< mean height of an empty pot's floor, from scene to scene
void compare_ranges(CaptureMode mode);  ///< axial noise over distance, border, valid share
void compare_edges(CaptureMode mode);   ///< shadows, noise of an edge
void compare_times();                   ///< temporal noise, warming up, units
void compare_materials();               ///< milky plastic, a black glossy mug
void compare_turbid();                  ///< liquids that scatter, in geometric and photometric frames

}  // namespace fathom
