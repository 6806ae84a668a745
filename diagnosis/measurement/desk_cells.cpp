#include "diagnosis/measurement/desk_cells.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace fathom {
namespace {

constexpr int kCellColumns = static_cast<int>(kImageWidth_px / kBiasCell_px),
              kCellRows = static_cast<int>(kImageHeight_px / kBiasCell_px);
constexpr double kFullCell = kBiasCell_px * kBiasCell_px;
constexpr double kMostly = 0.75;  ///< of a cell, in one cloud: where less is desk, blocks hold an edge
/// [px] A unit's bias has a deviation of 0.1 and blocks on a slope one of as much: three of both together. Things lower
/// than that, 3 mm at 0.65 m, pass for desk; so does what rises from it as gently as a bent desk, over much of the
/// image.
constexpr double kMostOff = 0.45;
constexpr double kMostBent = 2.5;  ///< [px] off the plane: a lens whose k1 is 0.1 bends corners so much

Eigen::Vector2d middle_of(std::size_t cell) {
  const auto column = static_cast<double>(cell % kCellColumns), row = static_cast<double>(cell / kCellColumns);
  return kBiasCell_px * Eigen::Vector2d(column + 0.5, row + 0.5);
}

/// A point of a cloud that may be desk.
struct MaybeDesk {
  std::size_t cell;
  float off_px, nearer_px, weight;
};

/// How far the desk is bent off its plane in each cell [px]. Lenses bend it like a quadratic of the image, by more than
/// `kMostOff` at its borders. It is fitted to what is within that, again and again, so that it grows from where the
/// plane holds and leaves out things that stand on the desk.
std::vector<double> bent_px(std::span<const MaybeDesk> points) {
  constexpr int kRounds = 8;
  constexpr std::size_t kFewestCells = 24;  // four to a coefficient
  constexpr std::size_t kCells = static_cast<std::size_t>(kCellColumns) * kCellRows;
  std::vector<double> sum(kCells), weight(kCells), bent(kCells);
  for (const MaybeDesk& point : points) {
    sum[point.cell] += point.weight * point.off_px;
    weight[point.cell] += point.weight;
  }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<BiasCell> cells;
    std::vector<double> off_px;
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      if (weight[cell] < kMostly * kFullCell) continue;
      const double mean = sum[cell] / weight[cell];
      if (std::abs(mean - bent[cell]) > kMostOff) continue;
      const Eigen::Vector2d middle = middle_of(cell);
      cells.push_back({middle.x(), middle.y(), 0.0, 1.0});
      off_px.push_back(mean);
    }
    if (cells.size() < kFewestCells) return std::vector<double>(kCells);
    const Quadratic fitted = quadratic_through(cells, off_px);
    for (std::size_t cell = 0; cell < kCells; ++cell) bent[cell] = fitted.dot(quadratic_at(middle_of(cell)));
  }
  return bent;
}

}  // namespace

void DeskCells::add(std::span<const SensedPoint> points, const Plane& desk, const LaboratoryRig& rig,
                    const FrameView& view) {
  DeskCells own;
  own.cells_.resize(static_cast<std::size_t>(kCellColumns) * kCellRows);
  const double of_inverse = rig.focal_px * rig.baseline_m;  // [px m] disparity times depth
  const Eigen::Vector3d inverse_desk = -desk.normal / desk.offset;
  const Eigen::Isometry3d to_desk = desk_from_camera(desk);
  const double clear = view.cup ? clear_of_cup(rig) : 0.0;
  const Eigen::Vector2d axis = view.cup ? axis_from_camera(rig, *view.cup) : Eigen::Vector2d::Zero();
  std::vector<MaybeDesk> maybe;
  maybe.reserve(points.size());
  for (const SensedPoint& sensed : points) {
    const Eigen::Vector3d point = sensed.point.cast<double>();
    const double off_px = of_inverse * (1.0 - inverse_desk.dot(point)) / point.z();
    if (std::abs(off_px) > kMostBent) continue;
    if (view.cup && ((to_desk * point).head<2>() - axis).squaredNorm() < clear * clear) continue;
    maybe.push_back({part_of_image(sensed.point, rig.focal_px, kCellColumns, kCellRows), static_cast<float>(off_px),
                     static_cast<float>(of_inverse / point.z() - of_inverse / kReferenceDistance_m), sensed.weight});
  }
  const std::vector<double> bent = bent_px(maybe);
  for (const MaybeDesk& point : maybe) {
    if (std::abs(point.off_px - bent[point.cell]) > kMostOff) continue;
    Cell& cell = own.cells_[point.cell];
    cell.pixels += point.weight;
    cell.error_px += point.weight * point.off_px;
    cell.nearer_px += point.weight * point.nearer_px;
  }
  for (Cell& cell : own.cells_)
    if (cell.pixels < kMostly * kFullCell) cell = {};
  add(own);
}

void DeskCells::add(const DeskCells& other) {
  cells_.resize(std::max(cells_.size(), other.cells_.size()));
  for (std::size_t i = 0; i < other.cells_.size(); ++i) {
    cells_[i].pixels += other.cells_[i].pixels;
    cells_[i].error_px += other.cells_[i].error_px;
    cells_[i].nearer_px += other.cells_[i].nearer_px;
  }
}

BiasView DeskCells::view() const {
  BiasView view;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (cell.pixels <= 0.0f) continue;
    const Eigen::Vector2d middle = middle_of(i);
    view.cells.push_back({middle.x(), middle.y(), static_cast<double>(cell.nearer_px / cell.pixels),
                          std::min(static_cast<double>(cell.pixels), kFullCell)});
    view.errors_px.push_back(static_cast<double>(cell.error_px / cell.pixels));
  }
  return view;
}

void DeskSights::add(const FrameRecord& frame, const DeskCells& cells) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * kBiasCell_px);
  for (const BiasCell& cell : cells.view().cells) {
    Eigen::AlignedBox2d& box =
        boxes_[{frame.bare_desk(), mm_from_metres(frame.distance_m), mm_from_metres(frame.lateral_m)}];
    box.extend(Eigen::Vector2d(cell.pixel_px() - half));
    box.extend(Eigen::Vector2d(cell.pixel_px() + half));
  }
}

void DeskSights::add(const DeskSights& others) {
  for (const auto& [place, box] : others.boxes_) boxes_[place].extend(box);
}

std::optional<Eigen::AlignedBox2d> DeskSights::at(const Factors& factors) const {
  const auto found = boxes_.find({factors.liquid == "none", factors.distance_mm, factors.lateral_mm});
  if (found == boxes_.end()) return std::nullopt;
  return found->second;
}

}  // namespace fathom
