// The exact triangulation of a bottom point through a flat liquid: what an ideal depth camera reports for it.
//
// Frame: z up, bottom of the liquid at z = 0, surface at z = fill, x to the sensor's right, y away from it, origin
// below the baseline's midpoint. Camera at (−b/2, 0, h), projector at (+b/2, 0, h), both with the same orientation (x
// right along the baseline, y down, z forward). Lengths in metres, angles in radians.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace fathom::theory {

struct TriangulationSetup {
  double sensor_height = 0.650;  ///< of the baseline above the bottom, more than `fill`
  double baseline = 0.075;
  double fill = 0.0;      ///< depth of the liquid
  double index = 1.333;   ///< of the liquid relative to air, >= 1
  double lateral = 0.0;   ///< x of the bottom point
  double distance = 0.0;  ///< y of the bottom point
  /// Of the optical axis below the horizontal. Nothing: the sensor aims at (0, distance, 0).
  std::optional<double> pitch = std::nullopt;
  double focal_px = 570.342;  ///< of the infrared camera
};

struct Triangulation {
  double height;                ///< m: of the measured point above the bottom
  Eigen::Vector3d measured;     ///< M: on the camera's undeviated ray, at the depth that the disparity tells
  double incidence_projector;   ///< θ1, at the surface
  double incidence_camera;      ///< θ4
  double disparity_px;          ///< focal_px (ξ_c − ξ_p), positive
  double epipolar_mismatch_px;  ///< focal_px (η_c − η_p): how far the two rays miss each other; 0 on the bisector
};

/// Both paths refracted by Snell's law, the image coordinates (ξ, η) = (x/z, y/z) of both air rays, and
/// Z = b / (ξ_c − ξ_p). Throws std::invalid_argument when the setup makes no sense or the point is not in front.
Triangulation triangulate(const TriangulationSetup& setup);

/// What the paper and exact optics say of the same bottom point.
struct RaisedBottom {
  double eq7;  ///< [m] height above the bottom by Eq. 7
  Triangulation exact;
};

/// Both. Throws std::invalid_argument as either does.
RaisedBottom raised_bottom(const TriangulationSetup& setup);

/// Inverse of triangulate in the liquid's depth: the fill in (0, max_fill] whose bottom is measured at `height`
/// (setup.fill is ignored). Nothing when there is none. Throws as triangulate, or unless 0 < max_fill < sensor_height.
std::optional<double> fill_from_height(double height, TriangulationSetup setup, double max_fill);

}  // namespace fathom::theory
