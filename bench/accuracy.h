// The parts of accuracy_sensor: each shoots its scenes and prints its rows.
#pragma once

#include <optional>
#include <string_view>

#include "sim/sensor/capture.h"

namespace fathom {

void compare_desks(CaptureMode mode);   ///< noise of a desk, with the same estimators on measured clouds
void compare_pots(CaptureMode mode);    ///< mean height of an empty pot's floor, from scene to scene
void compare_ranges(CaptureMode mode);  ///< axial noise over distance, border, valid share
void compare_edges(CaptureMode mode);   ///< shadows, noise of an edge
void compare_times();                   ///< temporal noise, warming up, units
void compare_materials();               ///< milky plastic, a black glossy mug
void compare_reflections();             ///< all light that a glass lets through and reflects
void compare_turbid();                  ///< liquids that scatter, in geometric and photometric frames

/// What a figure may be to meet its bar.
struct Bar {
  double low, high;
};

void print_title(std::string_view title);

/// One row: the simulated figure, the one it is compared with and where that is from; with a bar also the verdict.
void print_figure(std::string_view what, double simulated, std::optional<double> other, std::string_view source,
                  std::optional<Bar> bar = {});

/// What a reader must know about the rows above.
void print_note(std::string_view note);

inline Bar within_factor(double value, double factor) { return {value / factor, value * factor}; }
inline Bar within_share(double value, double share) { return {value * (1.0 - share), value * (1.0 + share)}; }
inline Bar within(double value, double most) { return {value - most, value + most}; }

}  // namespace fathom
