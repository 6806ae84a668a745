// Where camera and projector stand, and what their pixels are.
#pragma once

#include <Eigen/Core>

#include "blind/world.h"

namespace fathom::blind {

struct Eyes {
  Eigen::Vector3d camera, projector;  ///< in the world
  Eigen::Matrix3d world_from_camera;  ///< columns: right, down, forward
};

Eyes eyes_of(const Sensor& sensor);

/// Unit direction in the world of a place in the projector's image, whose pixels are those of the table.
Eigen::Vector3d projector_direction(const Eyes& eyes, const Eigen::Vector2d& pixel);

/// Place in the camera's image (with its faults) of a direction in the world.
Eigen::Vector2d camera_pixel(const Eyes& eyes, const Sensor& sensor, const Eigen::Vector3d& direction);

/// What the device takes for the disparity of a dot that it sees there: the shift from where it remembers the dot on
/// its reference plane, plus that plane's own disparity in the device's table.
double disparity_seen(const Sensor& sensor, const Eigen::Vector2d& projector_pixel, double camera_u);

/// A point of the cloud: camera frame, by the table's focal length and the image's middle [m].
Eigen::Vector3d cloud_point(const Eigen::Vector2d& pixel, double depth);

}  // namespace fathom::blind
