// Which part of the image a campaign's clouds show their desk in: a laboratory may cut its clouds out around the cup.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <tuple>

#include "diagnosis/measurement/desk_cells.h"
#include "diagnosis/measurement/frames.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

class DeskSights {
 public:
  void add(const FrameRecord& frame, const DeskCells& cells);
  void add(const DeskSights& others);

  /// The rectangle [px] that holds all desk seen with the cup at that place, or without one; nothing where none was.
  std::optional<Eigen::AlignedBox2d> at(const Factors& factors) const;

 private:
  using Place = std::tuple<bool, double, double>;  ///< bare, distance and lateral [mm]
  std::map<Place, Eigen::AlignedBox2d> boxes_;
};

}  // namespace fathom
