// Simulated figures beside published and measured ones, row by row.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fathom {

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
