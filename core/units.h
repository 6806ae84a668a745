// Conversions at the border of the program. Inside, everything is SI and radians.
#pragma once

#include <numbers>

namespace fathom {

inline constexpr double kMetresPerMm = 1e-3;

constexpr double metres_from_mm(double mm) { return mm * kMetresPerMm; }
constexpr double mm_from_metres(double metres) { return metres / kMetresPerMm; }
constexpr double radians_from_deg(double deg) { return deg * std::numbers::pi / 180.0; }
constexpr double deg_from_radians(double radians) { return radians * 180.0 / std::numbers::pi; }
constexpr double cubic_metres_from_ml(double ml) { return ml * 1e-6; }
constexpr double ml_from_cubic_metres(double volume) { return volume * 1e6; }

/// Absorption and scattering coefficients: 1/m from 1/mm.
constexpr double per_metre_from_per_mm(double per_mm) { return per_mm / kMetresPerMm; }
constexpr double per_mm_from_per_metre(double per_metre) { return per_metre * kMetresPerMm; }

}  // namespace fathom
