// A medium that scatters, and how it sends light on.
#pragma once

#include "sim/optics/phase.h"

namespace fathom {

/// A medium at one wavelength.
struct Turbid {
  double n = 1.0;           ///< refractive index
  double absorption = 0.0;  ///< coefficient μa [1/m]
  double scattering = 0.0;  ///< coefficient μs [1/m]
  double anisotropy = 0.0;  ///< g of Henyey & Greenstein's phase function; the mean cosine unless its peak is flat
  FlatPeak peak = {};       ///< of that function; a real medium's is not flat

  /// What unscattered light loses on its way [1/m].
  double extinction() const { return absorption + scattering; }
};

/// The medium's phase function, see henyey_greenstein().
inline double phase_function(const Turbid& medium, double cosine) {
  return medium.peak.density(cosine, medium.anisotropy);
}

/// The direction after one scattering, drawn from the phase function.
inline Eigen::Vector3d scatter(const Eigen::Vector3d& direction, const Turbid& medium, Rng& rng) {
  const double cosine = medium.peak.sample(medium.anisotropy, rng.uniform());
  return deflect(direction, cosine, sample_disc(rng));
}
/// The same for given numbers in [0, 1).
inline Eigen::Vector3d scatter(const Eigen::Vector3d& direction, const Turbid& medium, double cosine, double azimuth) {
  return deflect(direction, medium.peak.sample(medium.anisotropy, cosine), unit_vector(azimuth));
}

/// A medium in which light goes nearly as in this one: what is scattered by less than 25 degrees goes straight on, as
/// far as it is more than what is scattered by that angle, and the scattering coefficient falls until the reduced one
/// is as before. Walks see it after their first scattering, and so does the light that they are joined to: flights
/// become longer, and what a connection brings depends less on the direction from which the walk comes. What returns
/// from a liquid changes by less than a hundredth in all, and within some millimetres of where light enters it by some
/// hundredths (`test_optics`, ForwardPeak). The truncation is Potter's (J. Atmos. Sci. 27, 1970), and that the first
/// moment stays Iwabuchi's (J. Atmos. Sci. 63, 2006).
Turbid without_forward_peak(const Turbid& medium);

}  // namespace fathom
