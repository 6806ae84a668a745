#include "sim/optics/fresnel.h"

#include <cassert>
#include <cmath>

namespace fathom {

PolarisedReflectance polarised_reflectance(double cos_from, double n_from, double n_to) {
  assert(cos_from >= 0.0 && cos_from <= 1.0 + 1e-12);
  const double sin_to = n_from / n_to * std::sqrt(std::fmax(0.0, 1.0 - cos_from * cos_from));
  if (sin_to >= 1.0) return {1.0, 1.0};
  const double cos_to = std::sqrt(1.0 - sin_to * sin_to);
  const double s = (n_from * cos_from - n_to * cos_to) / (n_from * cos_from + n_to * cos_to);
  const double p = (n_to * cos_from - n_from * cos_to) / (n_to * cos_from + n_from * cos_to);
  return {s * s, p * p};
}

double fresnel_reflectance(double cos_from, double n_from, double n_to) {
  const auto [s, p] = polarised_reflectance(cos_from, n_from, n_to);
  return 0.5 * (s + p);
}

double hemispherical_reflectance(double n_from, double n_to) {
  // Light that is not totally reflected goes through as much as on the same paths backwards, where it fills the whole
  // hemisphere: n_from² (1 − R_from) = n_to² (1 − R_to). So only the smooth side is integrated.
  if (n_from > n_to) {
    const double ratio = n_to / n_from;
    return 1.0 - ratio * ratio * (1.0 - hemispherical_reflectance(n_to, n_from));
  }
  constexpr int kSteps = 1000;  // midpoint rule
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += fresnel_reflectance(cosine, n_from, n_to) * 2.0 * cosine;
  }
  return sum / kSteps;
}

}  // namespace fathom
