#include "diagnosis/unit/bias_view.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace fathom {
namespace {

/// The disparities of a view's plane, nearer_px, in the corners of the image's inner part.
std::array<double, 4> corners_of(const BiasView& view) {
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const BiasCell& cell : view.cells) {
    const Eigen::Vector3d at(cell.column_px / 320.0 - 1.0, cell.row_px / 240.0 - 1.0, 1.0);
    normal += cell.pixels * at * at.transpose();
    right += cell.pixels * cell.nearer_px * at;
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  constexpr double kInner = 0.7;
  std::array<double, 4> corners;
  for (int i = 0; i < 4; ++i)
    corners[i] = plane.dot(Eigen::Vector3d(i % 2 ? kInner : -kInner, i / 2 ? kInner : -kInner, 1.0));
  return corners;
}

}  // namespace

void set_states_by_pose(std::span<BiasView> views, PoseTolerance tolerance) {
  std::vector<std::array<double, 4>> firsts;  // of the view that began each state
  for (BiasView& view : views) {
    const std::array<double, 4> corners = corners_of(view);
    const auto is_alike = [&](const std::array<double, 4>& other) {
      std::array<double, 4> apart;
      for (int i = 0; i < 4; ++i) apart[i] = corners[i] - other[i];
      const double shift = std::accumulate(apart.begin(), apart.end(), 0.0) / 4.0;
      return std::abs(shift) <= tolerance.shift_px &&
             std::ranges::all_of(apart, [&](double one) { return std::abs(one - shift) <= tolerance.turn_px; });
    };
    std::size_t state = 0;
    while (state < firsts.size() && !is_alike(firsts[state])) ++state;
    if (state == firsts.size()) firsts.push_back(corners);
    view.state = static_cast<int>(state);
  }
}

}  // namespace fathom
