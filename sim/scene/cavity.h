// The hollow of a body that holds what is poured into it, for triangles of any kind: closed or not, single sheets or
// walls of two, turned either way, doubled, passing through each other.
//
// A grid of voxels finds the hollow: a liquid must climb to leave it. What is measured is exact where the walls are
// closed, since every level section is cut out of the triangles themselves. Openings narrower than a voxel (0.5 mm for
// cups) count as closed, wider than two as open; those between may be either.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "sim/scene/mesh.h"
#include "sim/scene/plane_cells.h"

namespace fathom {

class Cavity {
 public:
  double floor() const { return floor_; }                  ///< height of the lowest point [m]
  double rim() const { return rim_; }                      ///< highest level that is held [m]
  const Eigen::Vector3d& spill() const { return spill_; }  ///< where a level above the rim leaves first [m]
  double depth() const { return rim_ - floor_; }           ///< [m]
  double capacity() const { return volume(rim_); }         ///< [m³]

  /// Volume [m³] of a liquid in the cavity's deepest place that has risen to `level` [m], from floor to rim. It grows
  /// at once where the level passes an inner rim, by the pocket behind it.
  double volume(double level) const;

  /// The level [m] at which the cavity holds `volume` [m³], at most the capacity. For a volume that would be partly in
  /// a pocket behind an inner rim, that rim's height.
  double level_of(double volume) const;

  /// Whether a liquid at `level` [m] covers a point (world). Cuts the triangles once: not for many points.
  bool holds(const Eigen::Vector3d& point, double level) const;

  /// The liquid's surface at `level` [m], faces up, drawn out half-way into the wall, at most 0.25 mm: bodies overlap,
  /// the solid wins.
  Mesh surface(double level) const;

 private:
  friend std::optional<Cavity> find_cavity(std::span<const Mesh>);

  /// A vertical line on which the liquid stands on a surface.
  struct Column {
    Eigen::Vector2d at;
    double bottom, top;  ///< [m] between the surface and the first whole voxel above it
    std::int16_t layer;
  };
  /// A slice between two levels [m], and of its volume [m³] how much a liquid fills that has risen to a layer.
  struct Slice {
    double low, high;
    std::map<int, double> volume_by_layer;

    double volume(int layer) const;  ///< [m³] of a liquid that has risen to that layer
  };

  Cavity() = default;
  bool label_voxels();
  void find_columns();
  void find_rim();
  int layer_at(double level) const;
  std::vector<Segment> walls(double level) const;
  PlaneCells section(double level, std::span<const Segment> walls) const;
  Slice slice(double low, double high) const;
  std::vector<double> first_levels() const;
  void add_slices(Slice whole);

  std::vector<Triangle> triangles_;  ///< in the grid's frame
  VoxelGrid grid_;
  std::vector<std::int16_t> labels_;  ///< by voxel; see plane_cells.h
  int top_layer_ = 0;                 ///< first layer in which the liquid leaves
  std::vector<Column> columns_;
  double floor_ = 0.0, rim_ = 0.0;
  Eigen::Vector3d spill_ = Eigen::Vector3d::Zero();
  std::vector<Slice> slices_;  ///< from floor to rim
};

/// The cavity of largest volume in the meshes (world frame, z up, metres) that is open to the air. Nothing when none
/// holds a liquid at least two voxels deep: plates, boxes that are closed, cups upside down or with a hole in the
/// bottom.
std::optional<Cavity> find_cavity(std::span<const Mesh> meshes);

}  // namespace fathom
