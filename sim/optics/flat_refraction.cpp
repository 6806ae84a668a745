#include "sim/optics/flat_refraction.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fathom {

namespace {

/// Nearly exact where the upper point is far, as projectors are: the light aims at where the lower point seems to be
/// from straight above, and bends by Snell's law from there.
double first_offset(double height, double depth, double separation, double n_above, double n_below) {
  const double seeming = height + depth * n_above / n_below;
  const double paraxial = separation * height / seeming;
  const double sin_below = n_above / n_below * separation / std::sqrt(separation * separation + seeming * seeming);
  if (depth > height || sin_below >= 1.0) return paraxial;
  return std::max(separation - depth * sin_below / std::sqrt(1.0 - sin_below * sin_below), 0.0);
}

}  // namespace

FlatCrossing cross_flat_interface(double height, double depth, double separation, double n_above, double n_below) {
  assert(height > 0.0 && depth > 0.0 && separation >= 0.0);
  // A step this long leaves an error of its square, in units of the nearer point's distance: less than a rounding.
  const double last_step = 1e-8 * std::min(height, depth);
  double low = 0.0, high = separation;
  double offset = first_offset(height, depth, separation, n_above, n_below);
  double sin_above = 0.0, sin_below = 0.0;
  bool done = false;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double rest = separation - offset;
    const double inverse_above = 1.0 / std::sqrt(offset * offset + height * height);
    const double inverse_below = 1.0 / std::sqrt(rest * rest + depth * depth);
    sin_above = offset * inverse_above;
    sin_below = rest * inverse_below;
    if (done) break;
    const double residual = n_above * sin_above - n_below * sin_below;
    (residual > 0.0 ? high : low) = offset;
    const double cos_above = height * inverse_above, cos_below = depth * inverse_below;
    const double slope =
        n_above * cos_above * cos_above * inverse_above + n_below * cos_below * cos_below * inverse_below;
    double next = offset - residual / slope;
    done = std::fabs(next - offset) <= last_step;
    if (!done && (next <= low || next >= high)) next = 0.5 * (low + high);
    if (next == offset) break;
    offset = std::clamp(next, 0.0, separation);
  }
  return {offset, sin_above, sin_below};
}

double flat_spreading(const FlatCrossing& crossing, double height, double depth, double n_above, double n_below) {
  const double cos_above = std::sqrt(1.0 - crossing.sin_above * crossing.sin_above);
  const double cos_below = std::sqrt(1.0 - crossing.sin_below * crossing.sin_below);
  // r / sin θ_above and dr/dθ_above; the first has the limit height + depth n_above / n_below at normal incidence.
  const double r_over_sin = height / cos_above + depth * n_above / (n_below * cos_below);
  const double dr_dtheta = height / (cos_above * cos_above) +
                           depth / (cos_below * cos_below) * (n_above * cos_above) / (n_below * cos_below);
  return 1.0 / (r_over_sin * dr_dtheta * cos_below);
}

}  // namespace fathom
