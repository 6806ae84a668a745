// How far the desk of a cloud is off its plane, cell by cell of the image: what a unit's bias is learned from.
#pragma once

#include <span>
#include <vector>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/unit/bias_view.h"

namespace fathom {

/// Sums over pixels of desk in square cells of the depth image, row by row. Of several clouds they add up.
class DeskCells {
 public:
  /// Of the points of one cloud; `desk` as it was fitted to them, clear of the cup.
  void add(std::span<const SensedPoint> points, const Plane& desk, const LaboratoryRig& rig, const FrameView& view);
  void add(const DeskCells& other);
  /// Of clouds in one pose, whose planes are fitted to the parts of the desk that each shows: a bias bends those parts,
  /// and so turns each plane in its own way. The planes are turned to where the clouds agree best, then all is added.
  static DeskCells of_one_pose(std::vector<DeskCells> clouds);

  /// The cells that are mostly desk in any of the clouds; empty where there are none.
  BiasView view() const;

 private:
  struct Cell {
    float pixels = 0.0f, error_px = 0.0f, nearer_px = 0.0f;  ///< sums of the weights, and of these times weights
  };
  /// With a plane, as coefficients of plane_at(), added to the errors.
  void turn(const Eigen::Vector3d& plane);

  std::vector<Cell> cells_;  ///< empty before the first cloud
};

}  // namespace fathom
