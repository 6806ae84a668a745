// The dots as a body shows them that scatters: each spread by all the ways that light goes from it.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/image.h"
#include "sim/sensor/blurred_pattern.h"

namespace fathom {

/// Light that returned out of a body.
struct SpreadLight {
  float dx_steps, dy_steps;  ///< on the pattern's grid, from where the projector's straight way to the exit lies
  float dn;                  ///< radiance for dots of intensity 1
  float blur_steps;          ///< standard deviation of the blur that this light is given
};

class SpreadDots {
 public:
  /// Around straight ways that lie between `low` and `high` on the grid. `lights` stand for the whole neighbourhood.
  SpreadDots(const BlurredPattern& pattern, std::span<const SpreadLight> lights, const Eigen::Vector2d& low,
             const Eigen::Vector2d& high);

  /// Radiance [DN] where the straight way lies at `way`: Σ dn · BlurredPattern::intensity(way + offset, blur), but for
  /// interpolation. Light far from its straight way may be blurred more than it asks for.
  double operator()(const Eigen::Vector2d& way) const;

 private:
  /// A sum of lights of about one blur, sampled evenly.
  struct Layer {
    double spacing;         ///< [steps]
    int left = 0, top = 0;  ///< of the first sample [samples]
    Image<float> values = {};
  };

  std::vector<Layer> layers_;
};

}  // namespace fathom
