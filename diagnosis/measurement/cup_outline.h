// Where a cup stands and how wide it is: the circle that the points of its walls lie on.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/laboratory_rig.h"

namespace fathom {

struct CupOutline {
  Eigen::Vector2d off;  ///< [m] of the axis from where it should stand
  double wider;         ///< [m] radius less the rig's at that height, of outer and inner wall alike
  /// Pixels of which a mean would know as much as the fit does of x, y and the radius: where the walls are short arcs
  /// of few pixels, what pulls at one of them moves all three.
  Eigen::Vector3d pixels = Eigen::Vector3d::Zero();
};

/// [m] above the desk: the inner wall is looked at from there on, clear of a liquid whose surface is at `level`.
double inner_wall_above(const CupProfile& cup, double level);

/// Takes points one by one, in the frame of the desk. Those count that lie near the wall that the sensor can see there:
/// on its own side the outer one, clear of the desk, on the far side the inner one (of a wall that leans outward more
/// of it), between the rim and what stands in the cup: there a surface's edge, or what is seen through it, lies near
/// the wall and is none. On neither side do points count that lie as high as the surface should or, if that is higher,
/// as what is seen inside, nor on the sensor's side those that lie inside the cup: of a steep view of a leaning wall
/// the device sees nothing but the liquid.
class OutlineFit {
 public:
  /// `axis` [m]: from the foot of the camera to where the cup should stand; `fill` [m]: of what should stand in it.
  OutlineFit(const LaboratoryRig& rig, const Eigen::Vector2d& axis, double fill);

  /// `from_axis`, `height` [m].
  void add(const Eigen::Vector2d& from_axis, double height, double weight);

  /// By least squares of the points' distances from the circle: first of those within 12 mm of where the rig has it,
  /// then of those within 7 mm of where it was found, so that of a cup beside its place the liquid counts for no wall.
  /// Where that finds no cup of the rig's width, from where most of one's walls lie, up to 30 mm beside its place.
  /// Nothing with less than 60 pixels on either side, or where they lie on too short an arc.
  std::optional<CupOutline> solve();

  /// [m] from where the cup should stand to the farthest points that are of use.
  double reach() const;

 private:
  struct Sensed {
    Eigen::Vector2d from_axis;
    double height, weight;
    double inner_radius, outer_radius;  ///< [m] of the rig's walls at that height
    double inner_lean, outer_lean;      ///< cosine that looking down on a leaning wall takes off its facing the sensor
  };
  struct NearWall {
    Eigen::Vector2d outward;  ///< unit
    double excess;            ///< [m] outside the wall
    bool is_inside;           ///< the inner wall
  };
  void leave_out_liquid();
  std::optional<NearWall> near_wall(const Sensed& sensed, const CupOutline& outline, double gate) const;
  std::optional<CupOutline> step(const CupOutline& from, double gate) const;
  std::optional<CupOutline> fit_from(const Eigen::Vector2d& off) const;
  double scatter(const CupOutline& outline) const;
  double weaker_wall(const Eigen::Vector2d& off) const;
  Eigen::Vector2d place_of_walls() const;

  CupProfile cup_;
  double level_, inner_from_ = 0.0;  // [m]
  Eigen::Vector2d to_sensor_;        // unit
  double steepness_;                 // of the line of sight, height over distance
  std::vector<Sensed> sensed_;
  std::vector<SharedHeight> inside_;
};

}  // namespace fathom
