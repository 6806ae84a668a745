// What one cloud, or several of one pose, say of a unit's bias of disparity: how far the desk is off its own plane,
// cell by cell of the image.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
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

  Eigen::Vector2d pixel_px() const { return {column_px, row_px}; }
};

/// Two views are of one state when the device did the same to both beside what it does to all: one session, one pose.
struct BiasView {
  std::vector<BiasCell> cells;
  std::vector<double> errors_px;  ///< of each cell: mean disparity measured minus that of the fitted plane
  int state = kNoState;
};

/// 1, column and row of the depth image, these from −1 to 1.
inline Eigen::Vector3d plane_at(const Eigen::Vector2d& pixel_px) {
  return {1.0, pixel_px.x() / 320.0 - 1.0, pixel_px.y() / 240.0 - 1.0};
}

/// Of chance making a normal score as large as this, either way, in any of so many looks, at most.
inline double p_of_looks(double sigmas, std::size_t looks) {
  return std::min(1.0, static_cast<double>(looks) * std::erfc(std::abs(sigmas) / std::numbers::sqrt2));
}

/// The plane, as coefficients of plane_at(), that is nearest to a value of each cell; cells count by their pixels.
Eigen::Vector3d plane_through(std::span<const BiasCell> cells, std::span<const double> values);

/// 1, x, y, x², x y, y² with x, y as of plane_at(): what a lens makes of a plane, and what is smoothest in a bias.
using Quadratic = Eigen::Matrix<double, 6, 1>;
Quadratic quadratic_at(const Eigen::Vector2d& pixel_px);

/// The same as plane_through() of quadratics; terms that the cells do not settle are small.
Quadratic quadratic_through(std::span<const BiasCell> cells, std::span<const double> values);

/// What each cell has of `nearer_px`.
std::vector<double> nearer_px(std::span<const BiasCell> cells);

/// 1 σ of a whole cell's mean that its neighbours do not share [px]: the median second difference along rows, as of
/// normal errors. A smooth bias has next to none.
double own_error_px(const BiasView& view);

/// How views of one scene scatter about their mean, where they bend alike: a smooth error of a view moves such wide
/// shapes more than cells that differ from their neighbours let expect.
struct ViewScatter {
  double squares_px2 = 0.0;  ///< of what each view has of the three quadratic shapes that have no plane in them
  double free = 0.0;         ///< how many of them are independent

  void add(std::span<const BiasView> views);
  /// 1 σ of a cell of one view, were its cells' errors independent; nothing where no scene has two views.
  std::optional<double> cell_px() const;
};

/// How far the disparities of two desks may lie apart in one pose: all alike, and in each corner of the image beside
/// that.
struct PoseTolerance {
  double shift_px = 0.7, turn_px = 0.7;
};

/// Gives views whose desks lie alike the same state; numbers from 0.
void set_states_by_pose(std::span<BiasView> views, PoseTolerance tolerance = {});

}  // namespace fathom
