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

/// A medium in which light spreads nearly as in this one, with fewer and longer flights: the phase function's peak is
/// made flat within 25 degrees, what that cuts off counts as light that goes straight on, and the scattering
/// coefficient is lowered until the reduced one is as before. Walks use it from their first scattering on, and so do
/// connections to them, which then depend less on the direction from which the walk comes. What returns from a liquid
/// changes by less than a hundredth in all, and by some hundredths within some millimetres of where light enters it
/// (`test_optics`, ForwardPeak). To cut the peak off is Potter's (J. Atmos. Sci. 27, 1970), to keep the first moment
/// Iwabuchi's (J. Atmos. Sci. 63, 2006).
Turbid without_forward_peak(const Turbid& medium);

}  // namespace fathom
