#include "diagnosis/unit/bias_view.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/median.h"

namespace fathom {
namespace {

/// The disparities of a view's plane, nearer_px, in the corners of the image's inner part.
std::array<double, 4> corners_of(const BiasView& view) {
  const Eigen::Vector3d plane = plane_through(view.cells, nearer_px(view.cells));
  constexpr double kInner = 0.7;
  std::array<double, 4> corners;
  for (int i = 0; i < 4; ++i)
    corners[i] = plane.dot(Eigen::Vector3d(1.0, i % 2 ? kInner : -kInner, i / 2 ? kInner : -kInner));
  return corners;
}

}  // namespace

Eigen::Vector3d plane_through(std::span<const BiasCell> cells, std::span<const double> values) {
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector3d at = plane_at(cells[i].pixel_px());
    normal += cells[i].pixels * at * at.transpose();
    right += cells[i].pixels * values[i] * at;
  }
  return normal.ldlt().solve(right);
}

std::vector<double> nearer_px(std::span<const BiasCell> cells) {
  std::vector<double> values;
  for (const BiasCell& cell : cells) values.push_back(cell.nearer_px);
  return values;
}

double own_error_px(const BiasView& view) {
  constexpr double kLeast_px = 0.003;  // what rounding to whole millimetres leaves in a cell
  std::vector<double> differences;
  const auto follows = [&](std::size_t i) {
    return view.cells[i + 1].row_px == view.cells[i].row_px &&
           view.cells[i + 1].column_px == view.cells[i].column_px + kBiasCell_px;
  };
  for (std::size_t i = 0; i + 2 < view.cells.size(); ++i)
    if (follows(i) && follows(i + 1))
      differences.push_back(std::abs(view.errors_px[i] - 2.0 * view.errors_px[i + 1] + view.errors_px[i + 2]));
  if (differences.empty()) return kLeast_px;
  const double deviation = median(differences) / 0.6745;  // of a normal from its median
  return std::max(kLeast_px, deviation / std::sqrt(6.0));
}

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
