// The pattern as it lights what is not seen sharply: blurred by a Gaussian of any width.
#pragma once

#include <span>
#include <vector>

#include "sim/render/light_walk.h"
#include "sim/sensor/pattern.h"

namespace fathom {

/// [samples²] by which linear interpolation blurs, on average.
inline constexpr double kLinearVariance = 1.0 / 6.0;

/// A pyramid of the pattern: each level is wider blurred than the one before, and sampled half as finely.
class BlurredPattern {
 public:
  /// Keeps a reference to `pattern`, which must outlive it; its brightness is read now.
  explicit BlurredPattern(const Pattern& pattern);

  struct Level {
    double variance;      ///< [steps²] of its blur, beside a dot's own
    double spacing;       ///< [steps] between its samples
    Image<float> values;  ///< the first is at grid position (0, 0)
  };

  const Pattern& sharp() const { return pattern_; }
  /// The finest first.
  std::span<const Level> levels() const { return levels_; }

  /// Pattern::intensity() blurred by a Gaussian of at most `sigma_steps`: by the widest level's that is not wider, or,
  /// below the first level's, not at all. The mean over the grid stays the same.
  double intensity(const Eigen::Vector2d& on_grid, double sigma_steps) const;

 private:
  const Pattern& pattern_;
  std::vector<Level> levels_;
};

/// Blur [grid steps, standard deviation] that light which walked is given: a part of its spread.
double blur_steps(const Rig& rig, const ReturnedLight& light);

/// Mean relative radiant intensity around the direction in which light that walked left the projector, over
/// blur_steps(): most of what chance makes of the dots is gone, and the light is blurred by that part of the width that
/// it has anyway.
double intensity_around(const BlurredPattern& pattern, const Rig& rig, const ReturnedLight& light);

}  // namespace fathom
