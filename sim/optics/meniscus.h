// The rise of a liquid at an upright wall: the exact Young–Laplace profile of two dimensions.
#pragma once

#include <vector>

namespace fathom {

/// Height at the wall above the level far away: ± l_c √(2 (1 − sin θ)) for an upright one [m]. Arguments as of
/// Meniscus; where contact angle and lean together leave (0, π), of a surface that stands upright.
double meniscus_rise(double contact_angle, double capillary_length, double wall_lean = 0.0);

/// z'' / (1 + z'²)^{3/2} = z / l_c², z → 0 far from the wall. With s = z / (2 l_c) = sin(φ/2), φ the surface's slope
/// angle, x / l_c = acosh(1/s) − 2 √(1 − s²) + constant (e.g. Landau & Lifshitz, Fluid Mechanics, §61, problem 1).
/// Valid for a wall whose radius of curvature is large beside the capillary length.
class Meniscus {
 public:
  /// `contact_angle` [rad], measured in the liquid, in (0, π); above π/2 the liquid is pushed down. `wall_lean` [rad]:
  /// by how much the wall leans away from the liquid as it rises; their sum in (0, π). `capillary_length` [m] > 0.
  Meniscus(double contact_angle, double capillary_length, double wall_lean = 0.0);

  struct Point {
    double height;     ///< [m] above the level far away
    double slope;      ///< dz/dx; negative for a rise
    double curvature;  ///< d²z/dx² [1/m]
  };
  /// At the distance x [m] from the wall. Behind the wall (x < 0) the straight line that goes on from it.
  Point at(double x) const;

  bool operator==(const Meniscus&) const = default;

 private:
  /// u = acosh(1/s) at x, in units of the capillary length; x as in the law above, its constant 0.
  double parameter_at(double x) const;

  double sign_;                         ///< +1 up, −1 down, 0 level
  double capillary_length_;             ///< [m]
  double u_wall_ = 0.0, x_wall_ = 0.0;  ///< at the wall
  std::vector<double> u_;               ///< from the wall outward
};

}  // namespace fathom
