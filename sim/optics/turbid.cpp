#include "sim/optics/turbid.h"

namespace fathom {

Turbid without_forward_peak(const Turbid& medium) {
  // A wider cone costs less and is farther from the truth.
  constexpr double kConeCosine = 0.9063;    // 25 degrees
  constexpr double kLeastAnisotropy = 0.3;  // wider peaks are no peaks
  const double g = medium.anisotropy;
  if (g < kLeastAnisotropy) return medium;
  Turbid flat = medium;
  flat.peak = FlatPeak(kConeCosine, g);
  flat.scattering *= (1.0 - g) / (1.0 - flat.peak.mean_cosine(g));
  return flat;
}

}  // namespace fathom
