#include "sim/optics/walk_length.h"

#include <algorithm>
#include <cmath>

namespace fathom {

double expected_steps(const Layer& slab, double angle) {
  // Walks end by roulette below a quarter of their weight: after 1 + log 4 of what its mean decay takes.
  const double kUntilTheEnd = 1.0 - std::log(kRouletteShare);
  constexpr double kDepthsOfDiffusion =
      2.5;  // below them light has no share to speak of, measured with isotropic media
  const Turbid& medium = slab.medium;
  const double through = std::min(1.0 - hemispherical_reflectance(medium.n, 1.0),
                                  1.0 - fresnel_reflectance(std::cos(angle), 1.0, medium.n));
  if (through <= 0.0) return 0.0;
  double steps = 1.0 / through;
  if (medium.scattering == 0.0) return kUntilTheEnd * steps;
  const double attenuation =
      3.0 * medium.absorption * (medium.absorption + medium.scattering * (1.0 - medium.anisotropy));
  const double depth = std::min(slab.thickness, kDepthsOfDiffusion / std::sqrt(attenuation));
  steps += 2.0 * medium.scattering * depth / through;
  if (medium.n > 1.0) {
    const double freed = 1.0 - std::sqrt(1.0 - 1.0 / (medium.n * medium.n));  // share of directions that get out
    steps += 1.0 / (slab.thickness * (medium.scattering + medium.absorption) * freed);
  }
  return kUntilTheEnd * steps;
}

}  // namespace fathom
