// The one path by which light crosses a plane interface between two points: Fermat's principle, solved to rounding.
#pragma once

namespace fathom {

/// Crossing of a plane interface by the refracted path from a point at `height` above it (index n_above) to a point at
/// `depth` below it (index n_below), the two a horizontal distance `separation` apart.
struct FlatCrossing {
  double offset;     ///< [m] horizontal distance of the crossing from the foot of the upper point, in [0, separation]
  double sin_above;  ///< sine of the angle to the interface's normal, above
  double sin_below;  ///< the same below; n_above sin_above = n_below sin_below
};

/// Solves n_above sin θ_above = n_below sin θ_below by Newton's method on the offset: the difference of both sides is
/// monotone in it, so the root exists and is unique. height, depth > 0, separation ≥ 0 [m]. Residual below 1e-15.
FlatCrossing cross_flat_interface(double height, double depth, double separation, double n_above, double n_below);

/// Solid angle dω at the upper point that lands on unit area perpendicular to the ray at the lower point [1/m²]: what
/// 1/r² is without an interface. From the flux tube between two cones: dω = sin θ dθ dφ lands on a ring of area
/// r (dr/dθ) dθ dφ, seen at cos θ_below, with r = height tan θ_above + depth tan θ_below.
double flat_spreading(const FlatCrossing& crossing, double height, double depth, double n_above, double n_below);

}  // namespace fathom
