#include "sim/optics/phase.h"

#include <cassert>
#include <numbers>

namespace fathom {

double henyey_greenstein(double cosine, double g) {
  assert(std::fabs(g) < 1.0);
  const double squared = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * std::numbers::pi * squared * std::sqrt(squared));
}

}  // namespace fathom
