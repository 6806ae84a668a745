#include "sim/optics/fresnel.h"

#include <cassert>
#include <cmath>

namespace fathom {

double fresnel_reflectance(double cos_from, double n_from, double n_to) {
  assert(cos_from >= 0.0 && cos_from <= 1.0 + 1e-12);
  const double sin_to = n_from / n_to * std::sqrt(std::fmax(0.0, 1.0 - cos_from * cos_from));
  if (sin_to >= 1.0) return 1.0;
  const double cos_to = std::sqrt(1.0 - sin_to * sin_to);
  const double s = (n_from * cos_from - n_to * cos_to) / (n_from * cos_from + n_to * cos_to);
  const double p = (n_to * cos_from - n_from * cos_to) / (n_to * cos_from + n_from * cos_to);
  return 0.5 * (s * s + p * p);
}

}  // namespace fathom
