// The projected dots: a tile of pseudo-random positions, repeated, each dot a Gaussian spot.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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
  /// `ir_px_per_depth_px` turns the model's dot size into grid steps.
  Pattern(const PatternModel& model, double ir_px_per_depth_px);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool has_dot(int column, int row) const { return dots_(column % tile_columns_, row % tile_rows_) != 0; }

  /// Gives every dot of the grid its own brightness, columns × rows, row by row; an empty vector takes it back to 1.
  void set_dot_gains(std::vector<float> gains) { gains_ = std::move(gains); }

  /// Relative radiant intensity in a direction: 1 at an isolated dot's centre, 0 outside the grid. `x`, `y` are the
  /// rectified image coordinates in units of the focal length, `focal_px` the focal length in depth pixels.
  double intensity(double x, double y, double focal_px) const;

  /// Mean of intensity() over the grid.
  double mean_intensity() const;

 private:
  static constexpr int kTableSize = 512;

  Image<std::uint8_t> dots_;   ///< one tile
  Image<std::uint16_t> near_;  ///< bit 4 r + c: a dot at (column − 1 + c, row − 1 + r); one tile
  std::array<std::array<float, 4>, kTableSize + 1> profile_{};  ///< Gaussian at −1 … 2 steps from a fraction of a step
  int tile_columns_, tile_rows_, columns_, rows_;
  double step_px_;
  double sigma_steps_;
  std::vector<float> gains_;
};

}  // namespace fathom
