#include "diagnosis/unit/desk_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/median.h"

namespace fathom {
namespace {

constexpr Eigen::Index kMapColumns = CellMap::ColsAtCompileTime, kMapRows = CellMap::RowsAtCompileTime;

constexpr double kReach_px = 30.0;                               ///< over which what a view has of its own is alike
constexpr std::array<Eigen::Index, 4> kPartSides{4, 8, 16, 32};  ///< cells; smaller squares hold an edge now and then
constexpr double kMostlySeen = 0.75;  ///< of as many cells as rectangles usually show: clouds may be thinned

CellMap nothing_seen() { return CellMap::Constant(std::numeric_limits<double>::quiet_NaN()); }

Eigen::Index row_of(const BiasCell& cell) { return static_cast<Eigen::Index>(cell.row_px / kBiasCell_px); }
Eigen::Index column_of(const BiasCell& cell) { return static_cast<Eigen::Index>(cell.column_px / kBiasCell_px); }

CellMap map_of(std::span<const BiasCell> cells, std::span<const double> values) {
  CellMap map = nothing_seen();
  for (std::size_t i = 0; i < cells.size(); ++i) map(row_of(cells[i]), column_of(cells[i])) = values[i];
  return map;
}

/// Of the cells that were seen.
template <typename Cells>
double mean_of(const Cells& cells) {
  return cells.isNaN().select(0.0, cells).sum() / static_cast<double>((!cells.isNaN()).count());
}

/// A rectangle of the image and what is seen in it.
struct Part {
  Eigen::Index row, column, height, width;
  double cells;  ///< with desk
  double mean_px;

  double share() const { return cells / static_cast<double>(height * width); }
};

/// Mean over all pairs of a part's cells of how the errors of one view go together [px²].
double covariance_within(const CellMap& map, const Part& part) {
  std::vector<Eigen::Array2d> cells;
  for (Eigen::Index row = part.row; row < part.row + part.height; ++row)
    for (Eigen::Index column = part.column; column < part.column + part.width; ++column)
      if (!std::isnan(map(row, column))) cells.emplace_back(static_cast<double>(column), static_cast<double>(row));
  double sum = 0.0;
  for (const Eigen::Array2d& one : cells)
    for (const Eigen::Array2d& other : cells) {
      const Eigen::Array2d alike = (-0.5 * (kBiasCell_px / kReach_px * (one - other)).square()).exp();
      sum += alike.x() * (kOwnOfColumns_px * kOwnOfColumns_px + kOwnOfPatches_px * kOwnOfPatches_px * alike.y());
    }
  return sum / static_cast<double>(cells.size() * cells.size());
}

/// All rectangles that are desk for the most part, each half over its neighbours.
std::vector<Part> parts_of(const CellMap& map) {
  std::vector<Part> parts;
  for (const Eigen::Index height : kPartSides)
    for (const Eigen::Index width : kPartSides)
      for (Eigen::Index row = 0; row + height <= kMapRows; row += height / 2)
        for (Eigen::Index column = 0; column + width <= kMapColumns; column += width / 2) {
          const auto seen = map.block(row, column, height, width);
          const auto cells = static_cast<double>((!seen.isNaN()).count());
          if (cells > 0.0) parts.push_back({row, column, height, width, cells, mean_of(seen)});
        }
  std::vector<double> shares;
  for (const Part& part : parts) shares.push_back(part.share());
  const double least = shares.empty() ? 0.0 : kMostlySeen * median(shares);
  std::erase_if(parts, [&](const Part& part) { return part.share() < least; });
  return parts;
}

}  // namespace

CellMap desk_beside_others(const std::map<int, BiasView>& views, int session) {
  CellMap sum = CellMap::Zero(), count = CellMap::Zero();
  for (const auto& [of, view] : views) {
    if (of == session) continue;
    const CellMap errors = map_of(view.cells, view.errors_px);
    sum += errors.isNaN().select(0.0, errors);
    count += errors.isNaN().select(CellMap::Zero(), CellMap::Ones());
  }
  std::vector<BiasCell> shared;
  std::vector<double> differences;
  const BiasView& own = views.at(session);
  for (std::size_t i = 0; i < own.cells.size(); ++i) {
    const Eigen::Index row = row_of(own.cells[i]), column = column_of(own.cells[i]);
    if (count(row, column) == 0.0) continue;
    shared.push_back(own.cells[i]);
    differences.push_back(own.errors_px[i] - sum(row, column) / count(row, column));
  }
  const Eigen::Vector3d plane = plane_through(shared, differences);
  for (std::size_t i = 0; i < shared.size(); ++i) differences[i] -= plane.dot(plane_at(shared[i].pixel_px()));
  return map_of(shared, differences);
}

std::vector<DeskDifference> desk_parts(const std::map<int, BiasView>& views, int session) {
  const CellMap map = desk_beside_others(views, session);
  const std::vector<BiasCell>& cells = views.at(session).cells;
  const CellMap nearer = map_of(cells, nearer_px(cells));
  double of_cell = 0.0, views_in_difference = 0.0;
  for (const auto& [of, view] : views) {
    const double share = of == session ? 1.0 : 1.0 / static_cast<double>(views.size() - 1);
    of_cell += std::pow(share * own_error_px(view), 2.0);
    views_in_difference += share * share;
  }
  const auto corner = [](Eigen::Index column, Eigen::Index row) -> Eigen::Vector2d {
    return kBiasCell_px * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
  };
  std::vector<DeskDifference> result;
  for (const Part& part : parts_of(map))
    result.push_back({session, corner(part.column, part.row), corner(part.width, part.height), part.mean_px,
                      std::sqrt(of_cell / part.cells + views_in_difference * covariance_within(map, part)),
                      mean_of(nearer.block(part.row, part.column, part.height, part.width)), 1});
  return result;
}

std::vector<DeskDifference> desk_differences(const std::map<int, BiasView>& views) {
  std::vector<DeskDifference> result;
  if (views.size() < 2) return result;
  for (auto view = views.size() == 2 ? std::next(views.begin()) : views.begin(); view != views.end(); ++view) {
    const std::vector<DeskDifference> parts = desk_parts(views, view->first);
    const auto most = std::ranges::max_element(
        parts, {}, [](const DeskDifference& part) { return std::abs(part.bias_px) / part.sigma_px; });
    if (most == parts.end()) continue;
    result.push_back(*most);
    result.back().looks = parts.size();
  }
  return result;
}

}  // namespace fathom
