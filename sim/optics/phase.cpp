#include "sim/optics/phase.h"

#include <cassert>
#include <numbers>

namespace fathom {

double henyey_greenstein(double cosine, double g) {
  assert(std::fabs(g) < 1.0);
  const double squared = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * std::numbers::pi * squared * std::sqrt(squared));
}

// With t = 1 + g² − 2 g cosine the function is (1 − g²) / (4π t^{3/2}), and integrals over the cosine are over powers
// of t.
FlatPeak::FlatPeak(double cone_cosine, double g) : cosine(cone_cosine) {
  const double t = 1.0 + g * g - 2.0 * g * cosine;
  aside = (1.0 - g * g) / (2.0 * g) * (1.0 / std::sqrt(t) - 1.0 / (1.0 + g));
  within = 2.0 * std::numbers::pi * (1.0 - cosine) * henyey_greenstein(cosine, g);
}

double FlatPeak::mean_cosine(double g) const {
  const double root = std::sqrt(1.0 + g * g - 2.0 * g * cosine);
  const double sum_aside =
      (1.0 - g * g) / (4.0 * g * g) * ((1.0 + g * g) / root + root - (1.0 + g * g) / (1.0 + g) - (1.0 + g));
  return (sum_aside + 0.5 * (1.0 + cosine) * within) / (aside + within);
}

}  // namespace fathom
