// The shape of what is seen in a cup, apart from its height: the mean over many placements shows what no single one
// does.
#pragma once

#include <array>
#include <bitset>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

using CupCells = std::bitset<kCupCells>;

/// Heights of the cells of a cup's raster [mm]; NaN of those that show no surface.
using CellHeights = std::array<double, kCupCells>;
CellHeights cell_heights(const FrameEstimates& estimates);

/// What one placement shows of its cup.
struct ContentSight {
  std::size_t condition = 0;
  Factors factors;
  CellHeights measured, predicted;  ///< by the nominal model
  CupCells cells;                   ///< in which both are known
};

/// "content_shape_mm" of a liquid and a cell: by how much what is seen there is higher than in the mean of the cells,
/// in the mean over placements. Pours, places and whatever else lifts all cells alike cancel.
struct ContentShape {
  Observation observation;
  int cell = 0;
  std::vector<std::shared_ptr<const ContentSight>> sights;

  /// What a model has for it; `heights` are those of a condition, nothing where they are not looked at: such conditions
  /// count as 0. Cells that the model no longer sees change as the others do.
  double predicted(const std::function<const CellHeights*(std::size_t condition)>& heights) const;
};

/// The cells of a region of the cup that a placement shows; all of its cells where it shows none of them clearly.
std::vector<SeenPart> parts_of_region(std::string_view region, const CupCells& seen, double radius_m);

/// Of every liquid and cell that at least three placements show; the error of a cell is how they scatter about the
/// model. `radius_m`: of the disc that the raster covers.
std::vector<ContentShape> content_shapes(std::vector<ContentSight> sights, double radius_m);

}  // namespace fathom
