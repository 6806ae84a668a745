// What one cloud, or several of one pose, say of a unit's bias of disparity: how far the desk is off its own plane,
// cell by cell of the image.
#pragma once

#include <span>
#include <vector>

namespace fathom {

inline constexpr double kBiasCell_px = 16.0;         ///< width and height of a cell of the depth image (640 × 480)
inline constexpr double kReferenceDistance_m = 1.2;  ///< of the plane that the device remembers
inline constexpr int kNoState = -1;                  ///< a state that no view has, or all views are of one

/// Desk in a square of the depth image whose middle lies there.
struct BiasCell {
  double column_px, row_px;
  double nearer_px;  ///< disparity minus that of the reference plane: the pixel is compared with the column − nearer_px
  double pixels;     ///< of desk in the square, mean over the view's clouds
};

/// Two views are of one state when the device did the same to both beside what it does to all: one session, one pose.
struct BiasView {
  std::vector<BiasCell> cells;
  std::vector<double> errors_px;  ///< of each cell: mean disparity measured minus that of the fitted plane
  int state = kNoState;
};

/// How far the disparities of two desks may lie apart in one pose: all alike, and in each corner of the image beside
/// that.
struct PoseTolerance {
  double shift_px = 0.7, turn_px = 0.7;
};

/// Gives views whose desks lie alike the same state; numbers from 0.
void set_states_by_pose(std::span<BiasView> views, PoseTolerance tolerance = {});

}  // namespace fathom
