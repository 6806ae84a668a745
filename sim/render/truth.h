// What each depth pixel really looks at, and what a noise-free triangulating camera would measure there.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/image.h"
#include "sim/render/connection.h"
#include "sim/scene/rig.h"

namespace fathom {

/// How a pixel sees its point; the codes of truth.exr's channel `path`.
enum class PathKind : std::uint8_t { nothing = 0, direct = 1, refracted = 2, scattered = 3 };
PathKind path_of(const SeenPoint& seen);

/// As small as may be: a frame has 300,000, and every pass over them takes as long as reading them does.
struct TruePixel {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] world, first diffuse point on the refracted chief ray
  std::optional<double>
      apparent_depth;      ///< [m] camera frame, exact triangulation; nothing where the projector is hidden
  float intensity = 0.0f;  ///< [DN] of a dot's centre there
  int object = 0;
  PathKind path = PathKind::nothing;
  /// The first surface of any kind on the chief ray, also a liquid's or a clear wall's; 0: none. It may be there where
  /// the point is not: behind glass may lie nothing.
  int first_object = 0;
  double first_depth = 0.0;  ///< [m] camera frame
};

/// Depth from the horizontal parallax of two rays: Z = b / (ξ_camera − ξ_projector) [m]; nothing when they do not meet
/// in front of the sensor.
std::optional<double> triangulated_depth(const Rig& rig, const Eigen::Vector3d& camera_direction,
                                         const Eigen::Vector3d& projector_direction);

/// Traces the chief ray of every depth pixel (width × height of the sensor).
Image<TruePixel> trace_truth(const PointLight& projector, const Rig& rig);

}  // namespace fathom
