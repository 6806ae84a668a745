// Where in the image a session's desk is read otherwise than in the other sessions of a campaign.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

#include "diagnosis/unit/bias_view.h"

namespace fathom {

/// A number for each square of kBiasCell_px of a depth image of 640 × 480; NaN where no desk was seen.
using CellMap = Eigen::Array<double, 30, 40>;

/// What a view of a desk has of its own: alike down the image's columns, and in patches. Of scenes that one Kinect saw
/// from the same pose no size of rectangle differs by more than two such views, things on the desks apart
/// (tests/diagnosis/unit/real_desks_test.cpp): squares of 64 px by 0.034 px, of 256 px by 0.015 px, and strips of 64 px
/// that are 256 px tall by 0.034 px.
inline constexpr double kOwnOfColumns_px = 0.027, kOwnOfPatches_px = 0.01;

/// Disparity [px] in a session minus its mean in the others, planes taken off: the sensor's own bias is the same in all
/// sessions and cancels, and its poses are planes. Views by session, with cells in each.
CellMap desk_beside_others(const std::map<int, BiasView>& views, int session);

/// A rectangle of the depth image in which a session's desk differs from the others'.
struct DeskDifference {
  int session = 0;
  Eigen::Vector2d first_px{0, 0}, size_px{0, 0};  ///< its upper left corner; width and height
  double bias_px = 0.0;                           ///< mean of desk_beside_others() in it
  double sigma_px = 0.0;                          ///< 1 σ of that, were the sessions alike
  double nearer_px = 0.0;                         ///< where the desk lies there, as BiasCell has it
  std::size_t looks = 0;                          ///< rectangles that were looked at

  /// Of chance making as much in any of them, at most.
  double p() const { return p_of_looks(bias_px / sigma_px, looks); }
};

/// All rectangles of 64 to 512 px that are desk for the most part, each half over its neighbours. At least two views.
std::vector<DeskDifference> desk_parts(const std::map<int, BiasView>& views, int session);

/// Of each session the one that differs most, in σ; of two sessions only the second is said to differ.
std::vector<DeskDifference> desk_differences(const std::map<int, BiasView>& views);

}  // namespace fathom
