// Direct light in and on an upright opaque cup, in closed form: what a camera's ray sees there, and the projector's way
// to it.
#pragma once

#include <optional>
#include <vector>

#include "core/pose.h"
#include "sim/scene/liquid_top.h"
#include "sim/scene/setup.h"

namespace fathom {

/// A liquid under its surface, down to the next one or the bottom.
struct LiquidLayer {
  LiquidTop top;
  bool level;  ///< whether the top is a plane at the height `at`
  double at;   ///< [m]
  double n, absorption;
  bool opaque;              ///< scatters: nothing below its surface is seen
  double transport_length;  ///< [m] 1/μs′ of what scatters
  double core_rad;          ///< standard deviation of two dots' correlation
  double albedo;            ///< of what scatters, as a surface

  bool operator==(const LiquidLayer&) const = default;
};

/// A cup of revolution with opaque walls.
struct CupBody {
  Eigen::Vector2d axis;
  double rim, rim_radius;  ///< height above the desk, inner radius there
  double albedo;
  std::vector<Eigen::Vector2d> bottom;  ///< (radius, height), from the axis to where the wall begins
  std::vector<Eigen::Vector2d> inner;   ///< the whole inside
  std::vector<Eigen::Vector2d> outer;

  bool operator==(const CupBody&) const = default;
};

struct CupOptics {
  CupBody body;
  std::vector<LiquidLayer> layers;  ///< from above

  /// Of what stands in the cup; null in an empty one.
  const LiquidTop* surface() const { return layers.empty() ? nullptr : &layers.front().top; }

  bool operator==(const CupOptics&) const = default;
};

/// Of the cups of a scene that stand at one place: what stands in the first is in all (see sim/effects/stratification).
/// Nothing without a cup. Throws Error when it is of a glTF file or clear: light that passes walls is not in this
/// model.
std::optional<CupOptics> cup_optics(const Setup& setup);

/// The bottom or the opaque surface as a ray from the camera sees it, and the light there.
struct LitPoint {
  Eigen::Vector3d point;                ///< [m] world
  Eigen::Vector3d projector_direction;  ///< unit, in which the light left the projector
  double reflected;                     ///< [1/m²] albedo · irradiance · transmittance, as radiance_dn() takes it
};

/// Nothing where the ray meets a wall, or the projector's light does before it gets there.
std::optional<LitPoint> look_into(const CupOptics& cup, const Ray& camera_ray, const Eigen::Vector3d& projector);

/// The outer wall or, through the opening, the inner one above the `surface` of what stands in the cup, if anything
/// does. Nothing where a ray from the camera meets anything else, or where the projector's light does not come.
std::optional<LitPoint> look_at_wall(const CupBody& cup, const LiquidTop* surface, const Ray& camera_ray,
                                     const Eigen::Vector3d& projector);

/// Whether the straight way from a point of the desk to a source passes the cup.
bool is_hidden(const CupBody& cup, const Eigen::Vector3d& on_desk, const Eigen::Vector3d& source);

}  // namespace fathom
