#include "sim/scene/rig.h"

#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

/// Level, to the right of the direction: the camera's x axis if it were not rolled.
Eigen::Vector3d level_right(const Eigen::Vector3d& forward) {
  const double horizontal = forward.head<2>().norm();
  if (horizontal < 1e-12) return Eigen::Vector3d::UnitX();
  return {forward.y() / horizontal, -forward.x() / horizontal, 0.0};
}

}  // namespace

Pose camera_pose(const Eigen::Vector3d& midpoint_in_world, double pitch, double yaw, double roll, double baseline) {
  // Columns: the camera's right, down and forward in the world when it looks along +y.
  Eigen::Matrix3d world_from_level;
  world_from_level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  Pose world_from_camera;
  world_from_camera.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * world_from_level *
                               Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
  world_from_camera.translation() = midpoint_in_world - 0.5 * baseline * world_from_camera.linear().col(0);
  return world_from_camera;
}

double roll_of(const Eigen::Matrix3d& world_from_camera) {
  const Eigen::Vector3d right = world_from_camera.col(0), forward = world_from_camera.col(2);
  const Eigen::Vector3d level = level_right(forward);
  return std::atan2(right.dot(forward.cross(level)), right.dot(level));
}

bool PatternImage::operator==(const PatternImage& other) const {
  if (brightness == other.brightness) return true;
  return brightness && other.brightness && brightness->width() == other.brightness->width() &&
         std::ranges::equal(brightness->pixels(), other.brightness->pixels());
}

}  // namespace fathom
