#include "blind/eye.h"

#include <Eigen/Geometry>
#include <cmath>

#include "blind/device_law.h"

namespace fathom::blind {
namespace {

const Eigen::Vector2d kMiddlePx{320.0, 240.0};

}  // namespace

Eyes eyes_of(const Sensor& sensor) {
  const double c = std::cos(sensor.pitch), s = std::sin(sensor.pitch);
  const Eigen::Vector3d right(1, 0, 0), down(0, -s, -c), forward(0, c, -s);
  const double cr = std::cos(sensor.roll), sr = std::sin(sensor.roll);
  Eyes eyes;
  eyes.world_from_camera << cr * right + sr * down, cr * down - sr * right, forward;
  const Eigen::Vector3d middle(0, 0, sensor.height);
  eyes.camera = middle - 0.5 * sensor.baseline * eyes.world_from_camera.col(0);
  eyes.projector = middle + 0.5 * sensor.baseline * eyes.world_from_camera.col(0);
  return eyes;
}

Eigen::Vector3d projector_direction(const Eyes& eyes, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d tangent = (pixel - kMiddlePx) / kTableFocalPx;
  return (eyes.world_from_camera * tangent.homogeneous()).normalized();
}

Eigen::Vector2d camera_pixel(const Eyes& eyes, const Sensor& sensor, const Eigen::Vector3d& direction) {
  const Eigen::Vector2d tangent = (eyes.world_from_camera.transpose() * direction).hnormalized();
  return sensor.principal_px + sensor.focal_px * (1.0 + sensor.radial_k1 * tangent.squaredNorm()) * tangent;
}

double disparity_seen(const Sensor& sensor, const Eigen::Vector2d& projector_pixel, double camera_u) {
  const Eigen::Vector2d tangent = (projector_pixel - kMiddlePx) / kTableFocalPx;
  const double reference = sensor.baseline / (1e-3 * kReferenceMm);
  const Eigen::Vector2d of_reference(tangent.x() + reference, tangent.y());
  const double reference_u = sensor.principal_px.x() +
                             sensor.focal_px * (1.0 + sensor.radial_k1 * of_reference.squaredNorm()) * of_reference.x();
  // The unit measures shifts against its memorised image. That this was of 1.2 m its table knows, not its own numbers.
  return camera_u - reference_u + kTableFocalPx * kTableBaseline / (1e-3 * kReferenceMm) + sensor.disparity_offset_px;
}

Eigen::Vector3d cloud_point(const Eigen::Vector2d& pixel, double depth) {
  const Eigen::Vector2d tangent = (pixel - kMiddlePx) / kTableFocalPx;
  return depth * tangent.homogeneous();
}

}  // namespace fathom::blind
