// The projected dots: a tile of pseudo-random positions, repeated, each dot a Gaussian spot.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/image.h"
#include "sim/scene/rig.h"

namespace fathom {

/// One tile (tile_columns × tile_rows; 1 = dot). It can be laid side by side: no two dots are 8-adjacent across the
/// seams either, it is point-symmetric, and every 9×9 window differs from every other within ±136 positions of its row
/// by at least 5 cells. Same model and seed, same tile. Throws Error when the model's density leaves no such tile.
Image<std::uint8_t> make_dot_tile(const PatternModel& model);

/// The smallest number of cells in which two `size`×`size` windows of the repeated tile differ that lie in the same row
/// at most `range` positions apart.
int least_window_difference(const Image<std::uint8_t>& tile, int size, int range);

class Pattern {
 public:
  /// `ir_px_per_depth_px` turns the model's dot size into grid steps; `pincushion` is OpticsModel::projector_k1.
  Pattern(const PatternModel& model, double ir_px_per_depth_px, double pincushion = 0.0);

  int columns() const { return brightness_.width(); }
  int rows() const { return brightness_.height(); }
  bool has_dot(int column, int row) const { return permanent_(column, row) > 0.0f; }
  /// Of the dot at each place of the grid, columns × rows; 0 where there is none.
  const Image<float>& brightness() const { return brightness_; }
  double sigma_steps() const { return sigma_steps_; }

  /// Where a direction lies on the grid: dot (i, j) has its centre at (i, j), the grid's middle lies on the projector's
  /// axis. `x`, `y` are the rectified image coordinates in units of the focal length, `focal_px` in depth pixels.
  Eigen::Vector2d on_grid(double x, double y, double focal_px) const {
    const double steps = focal_px / step_px_ / (1.0 + pincushion_ * (x * x + y * y));
    return {x * steps + 0.5 * (columns() - 1), y * steps + 0.5 * (rows() - 1)};
  }

  /// Gives every dot of the grid its own brightness, columns × rows, row by row; none: 1 for all.
  void set_dot_gains(std::span<const float> gains);

  /// Relative radiant intensity at a place on the grid: 1 at an isolated dot's centre, 0 outside.
  double intensity(const Eigen::Vector2d& on_grid) const;
  /// The same of dots that are out of focus: as much light, spread by another `blur_steps` (standard deviation).
  double intensity(const Eigen::Vector2d& on_grid, double blur_steps) const;

  /// Mean of intensity() over the grid.
  double mean_intensity() const;

 private:
  static constexpr int kTableSize = 512;

  Image<float> permanent_;                              ///< brightness of the whole grid without speckle
  Image<float> brightness_;                             ///< with it
  std::array<Eigen::Array4f, kTableSize + 1> profile_;  ///< Gaussian at −1 … 2 steps from a fraction of a step
  double step_px_;
  double sigma_steps_;
  double pincushion_;
};

/// How far the dots on a surface are spread by defocus: the disc of light that the camera's aperture makes of a point,
/// and the width of the projector's beam.
class Defocus {
 public:
  explicit Defocus(const SensorModel& sensor);

  /// Standard deviation in grid steps, at `depth` [m] along the axis.
  double blur_steps(double depth) const { return std::sqrt(blur2_steps(1.0 / depth)); }
  /// Its square, by inverse depth [1/m].
  double blur2_steps(double dioptres) const {
    const double disc = disc_ * (dioptres - focus_dioptres_), beam = beam_ * dioptres;
    return disc * disc + beam * beam;
  }

 private:
  double disc_ = 0.0, focus_dioptres_ = 0.0, beam_ = 0.0;
};

/// Where a direction in the world lies on the pattern's grid; nothing behind the projector.
inline std::optional<Eigen::Vector2d> on_grid(const Pattern& pattern, const Rig& rig,
                                              const Eigen::Vector3d& direction) {
  const std::optional<Eigen::Vector2d> at = rig.rectified(direction);
  return at ? std::optional(pattern.on_grid(at->x(), at->y(), rig.sensor.focal_px)) : std::nullopt;
}

/// Relative radiant intensity in a direction in the world; 0 behind the projector.
inline double intensity_towards(const Pattern& pattern, const Rig& rig, const Eigen::Vector3d& direction,
                                double blur_steps = 0.0) {
  const std::optional<Eigen::Vector2d> at = on_grid(pattern, rig, direction);
  return at ? pattern.intensity(*at, blur_steps) : 0.0;
}

}  // namespace fathom
