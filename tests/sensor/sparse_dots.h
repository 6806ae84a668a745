// A cup with water lit by few dots, far enough apart to be looked at one by one, each with its exact image.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/render/truth.h"
#include "sim/sensor/pattern.h"
#include "tests/render/scenes.h"
#include "tests/sensor/exact_dot.h"

namespace fathom {

/// One of the dots, where it lands on a ground.
struct SparseDot {
  Eigen::Vector2d direction;  ///< of the projector: rectified, in units of the focal length
  DotImage exact;
};

/// The paper's cup with 30 mm of water in the middle of an image of 640 × 512 infrared pixels.
class SparseDots {
 public:
  SparseDots(double distance_mm, double absorption_per_mm);

  const LitScene& view() const { return view_; }
  double distance_mm() const { return distance_mm_; }
  /// Standard deviation of a dot in units of the focal length.
  double dot_sigma() const;
  Ground desk() const { return {0.0, 0.55}; }
  Ground bottom() const;

  /// The dots that lie wholly on the ground, seen and lit.
  std::vector<SparseDot> on(const Ground& ground) const;

  /// The infrared image in direct light [DN].
  Image<float> image(int samples_across) const;

 private:
  bool stands_alone(int column, int row) const;
  bool is_wholly_on(const Ground& ground, const Eigen::Vector2d& centre_ir_px) const;

  double distance_mm_;
  LitScene view_;
  Pattern pattern_;
  std::vector<Eigen::Vector2i> lit_;  ///< columns and rows of the pattern
  Image<TruePixel> truth_;
};

/// Sum and first moment of the pixels around a place: of one dot, if it lies there.
DotImage measured_dot(const Image<float>& image, const Eigen::Vector2d& near_ir_px);

/// How far from a dot's centre pixels count to it. It ends two grid steps, 4 infrared pixels, from there; neither desk
/// nor water stretch it by a tenth.
inline constexpr int kDotReachIrPx = 6;

}  // namespace fathom
