// The closed theory of the raised bottom: the paper's Eq. 1–7, one function each, with its symbols.
// Lengths in any one unit (metres in this program), angles in radians.
//
// - w: depth of the liquid;
// - s: depth of the measured point M below the surface;
// - m: height of M above the bottom;
// - θ1: incidence angle, from the vertical;
// - θ2: refraction angle, from the vertical;
// - n: index of the liquid relative to air, n >= 1;
// - h: height of the sensor above the bottom;
// - b: baseline;
// - d: horizontal distance of the bottom point, on the baseline's perpendicular bisector;
// - p: horizontal distance of that point from the projector or the camera.
//
// All of them throw std::invalid_argument outside their validity.
#pragma once

#include <optional>

namespace fathom::theory {

/// Eq. 1: s = w tan θ2 / tan θ1 with θ2 of Eq. 2. For 0 <= θ1 <= π/2, w >= 0; at θ1 = 0 the limit w / n.
double apparent_depth(double w, double theta_1, double n);

/// Eq. 2, Snell's law: θ2 = arcsin(sin θ1 / n). For 0 <= θ1 <= π/2.
double refraction_angle(double theta_1, double n);

/// Eq. 3: m = w − s, the height at which the bottom is measured. Exact when θ1 is the true incidence angle and the
/// point lies on the bisector.
double raised_height(double w, double theta_1, double n);

/// Eq. 4: θ1 = θ4 = arctan(p / h). Takes the straight line to the bottom for the refracted path, so it is too small
/// once w is not small against h. For p >= 0, h > 0.
double incidence_angle(double p, double h);

/// Eq. 5: p = √(d² + (b/2)²). For b >= 0.
double horizontal_distance(double d, double b);

/// Eq. 6: θ1 = θ4 = arctan(√(d² + (b/2)²) / h), Eq. 4 of Eq. 5.
double incidence_angle_at(double d, double b, double h);

/// Where the closed form of Eq. 7 is asked: the sensor, the liquid and the bottom point.
struct BottomView {
  double h;  ///< height of the sensor above the bottom
  double b;  ///< baseline
  double d;  ///< horizontal distance of the bottom point
  double n;  ///< index of the liquid
};

/// Eq. 7: m = w − h w tan(arcsin(sin(arctan(p/h)) / n)) / p with p of Eq. 5, which is Eq. 3 of Eq. 6.
double raised_height_at(double w, const BottomView& view);

/// Inverse of Eq. 3: the depth w of a liquid whose bottom is measured at height m >= 0. Linear in m.
/// Nothing when no liquid explains it: n = 1 raises nothing.
std::optional<double> fill_from_height(double m, double theta_1, double n);

/// Inverse of Eq. 7, as above.
std::optional<double> fill_from_height_at(double m, const BottomView& view);

/// Fig. 12: the difference |θ1 − θ4| for a sensor that looks straight down, at the edge of the camera's horizontal
/// field of view that lies away from the projector, at the given range along the camera's ray:
///   arctan(tan(fov/2) + b / (range cos(fov/2))) − fov/2.
/// For b >= 0, 0 < fov < π, range > 0. The text leaves the configuration open; this one gives the printed 6.95° for
/// b = 75 mm, fov = 58.5°, range = 500 mm. The difference is no maximum over the field: below the camera it is
/// arctan(b / range) = 8.53°.
double skew_at_field_edge(double b, double fov, double range);

}  // namespace fathom::theory
