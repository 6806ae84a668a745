// How far the desk of a cloud is off its plane, cell by cell of the image: what a unit's bias is learned from.
#pragma once

#include <Eigen/Geometry>
#include <compare>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/frames.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/unit/bias_view.h"

namespace fathom {

/// Clouds that show the same part of one desk: of a session, with the cup at one place or without it.
struct DeskScene {
  int session = 0;
  bool is_bare = false;
  double distance_m = 0.0, lateral_m = 0.0;  ///< of the cup

  auto operator<=>(const DeskScene&) const = default;
};

/// Sums over pixels of desk in square cells of the depth image, row by row. Of several clouds they add up.
class DeskCells {
 public:
  /// Of the points of one cloud; `desk` as it was fitted to them, clear of the cup.
  void add(std::span<const SensedPoint> points, const Plane& desk, const LaboratoryRig& rig, const FrameView& view);
  void add(const DeskCells& other);

  /// The cells that are mostly desk in any of the clouds; empty where there are none.
  BiasView view() const;

 private:
  struct Cell {
    float pixels = 0.0f, error_px = 0.0f, nearer_px = 0.0f;  ///< sums of the weights, and of these times weights
  };
  std::vector<Cell> cells_;  ///< empty before the first cloud
};

/// Of every placement that shows a scene.
using Desks = std::map<DeskScene, std::vector<DeskCells>>;

/// Which part of the image a campaign's clouds show their desk in: a laboratory may cut its clouds out around the cup.
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
