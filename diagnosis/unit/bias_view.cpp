#include "diagnosis/unit/bias_view.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

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

Quadratic quadratic_at(const Eigen::Vector2d& pixel_px) {
  const Eigen::Vector3d plane = plane_at(pixel_px);
  const double x = plane[1], y = plane[2];
  return {1.0, x, y, x * x, x * y, y * y};
}

Quadratic quadratic_through(std::span<const BiasCell> cells, std::span<const double> values) {
  constexpr double kLittle = 1e-3;  // of a cell of one pixel
  Eigen::Matrix<double, 6, 6> normal = kLittle * Eigen::Matrix<double, 6, 6>::Identity();
  Quadratic right = Quadratic::Zero();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Quadratic at = quadratic_at(cells[i].pixel_px());
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

void ViewScatter::add(std::span<const BiasView> views) {
  constexpr Eigen::Index kOfPlane = 3, kOfAll = 6;
  std::map<std::pair<double, double>, std::vector<double>> errors_of;  // of each cell, in all views
  for (const BiasView& view : views)
    for (std::size_t i = 0; i < view.cells.size(); ++i)
      errors_of[{view.cells[i].column_px, view.cells[i].row_px}].push_back(view.errors_px[i]);
  std::erase_if(errors_of, [&](const auto& cell) { return cell.second.size() < views.size(); });
  const auto cells = static_cast<Eigen::Index>(errors_of.size());
  if (views.size() < 2 || cells < 2 * kOfAll) return;
  Eigen::Matrix<double, Eigen::Dynamic, kOfAll> shapes(cells, kOfAll);
  Eigen::MatrixXd errors(cells, static_cast<Eigen::Index>(views.size()));
  Eigen::Index row = 0;
  for (const auto& [cell, of_views] : errors_of) {
    shapes.row(row) = quadratic_at({cell.first, cell.second}).transpose();
    errors.row(row++) = Eigen::Map<const Eigen::RowVectorXd>(of_views.data(), errors.cols());
  }
  errors.colwise() -= errors.rowwise().mean().eval();
  // L⁻¹ of shapesᵀ shapes = L Lᵀ makes them orthonormal, one after the other.
  const Eigen::LLT<Eigen::Matrix<double, kOfAll, kOfAll>> gram(
      Eigen::Matrix<double, kOfAll, kOfAll>(shapes.transpose() * shapes));
  const Eigen::MatrixXd by_shape = gram.matrixL().solve(shapes.transpose() * errors);
  squares_px2 += by_shape.bottomRows(kOfAll - kOfPlane).squaredNorm();
  free += static_cast<double>((kOfAll - kOfPlane) * (errors.cols() - 1));
}

std::optional<double> ViewScatter::cell_px() const {
  if (free <= 0.0) return std::nullopt;
  return std::sqrt(squares_px2 / free);
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
