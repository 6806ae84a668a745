// How light is sent on: by a small particle (the phase function of Henyey and Greenstein) and by a diffuse surface.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rng.h"

namespace fathom {

/// Density over solid angle [1/sr] of scattering by an angle of cosine `cosine` at anisotropy g ∈ (−1, 1), its mean
/// cosine: (1 − g²) / (4π (1 + g² − 2 g cosine)^{3/2}) (Henyey & Greenstein, Astrophys. J. 93, 1941). Integrates to 1.
double henyey_greenstein(double cosine, double g);

/// The cosine up to which a share `uniform` ∈ [0, 1) of the light is scattered: the inverse of the distribution
/// function (Witt, Astrophys. J. Suppl. 35, 1977), with the g of its denominator cancelled so that g → 0 is no case of
/// its own.
inline double sample_henyey_greenstein(double g, double uniform) {
  const double u = 2.0 * uniform - 1.0;
  const double denominator = 1.0 + g * u;
  const double numerator = u + g * (0.5 * (u * u + 3.0) + g * (u + 0.5 * g * (u * u - 1.0)));
  return std::clamp(numerator / (denominator * denominator), -1.0, 1.0);
}

/// The direction that makes an angle of the given cosine with a unit direction, at the azimuth of the point (x, y) ≠ 0.
inline Eigen::Vector3d deflect(const Eigen::Vector3d& direction, double cosine, const Eigen::Vector2d& azimuth) {
  // A right-handed basis about the direction (Duff et al., J. Computer Graphics Techniques 6, 2017).
  const double sign = std::copysign(1.0, direction.z());
  const double a = -1.0 / (sign + direction.z());
  const double b = direction.x() * direction.y() * a;
  const Eigen::Vector3d along_x(1.0 + sign * direction.x() * direction.x() * a, sign * b, -sign * direction.x());
  const Eigen::Vector3d along_y(b, sign + direction.y() * direction.y() * a, -direction.y());
  const Eigen::Vector2d sine = azimuth * std::sqrt((1.0 - cosine * cosine) / azimuth.squaredNorm());
  return sine.x() * along_x + sine.y() * along_y + cosine * direction;
}

/// A point in the unit disc, not its centre: its azimuth costs less than a sine and a cosine.
inline Eigen::Vector2d sample_disc(Rng& rng) {
  for (;;) {
    const double x = 2.0 * rng.uniform() - 1.0, y = 2.0 * rng.uniform() - 1.0, squared = x * x + y * y;
    if (squared <= 1.0 && squared > 0.0) return {x, y};
  }
}

/// The azimuth that is a share `turn` of the circle.
inline Eigen::Vector2d unit_vector(double turn) {
  const double angle = 2.0 * std::numbers::pi * turn;
  return {std::cos(angle), std::sin(angle)};
}

/// A phase function of Henyey & Greenstein's whose forward peak is flat: within a cone as much is scattered as at its
/// edge, and the rest is left out.
struct FlatPeak {
  double cosine = 1.0;  ///< of the cone's half angle
  double aside = 1.0;   ///< share of the light that the function with its peak scatters out of the cone
  double within = 0.0;  ///< what is left of its share in the cone

  FlatPeak() = default;
  FlatPeak(double cone_cosine, double g);

  /// Density over solid angle [1/sr]; integrates to 1.
  double density(double scattering_cosine, double g) const {
    return henyey_greenstein(std::min(scattering_cosine, cosine), g) / (aside + within);
  }
  double sample(double g, double uniform) const {
    const double share = uniform * (aside + within);
    if (share < aside) return std::min(sample_henyey_greenstein(g, share), cosine);
    return cosine + (1.0 - cosine) * (share - aside) / within;
  }
  /// Of the scattering angle's cosine. g ≠ 0.
  double mean_cosine(double g) const;
};

/// A direction from a diffuse (Lambertian) surface: density cos θ / π about its unit normal.
inline Eigen::Vector3d sample_diffuse(const Eigen::Vector3d& normal, Rng& rng) {
  const Eigen::Vector2d below = sample_disc(rng);  // Malley: the hemisphere's point above a point of the disc
  return deflect(normal, std::sqrt(1.0 - below.squaredNorm()), below);
}
/// The same for given numbers in [0, 1): the squared distance of the disc's point from its centre, and its azimuth.
inline Eigen::Vector3d sample_diffuse(const Eigen::Vector3d& normal, double squared, double turn) {
  return deflect(normal, std::sqrt(1.0 - squared), unit_vector(turn));
}

}  // namespace fathom
