#include "sim/sensor/reading.h"

#include "sim/sensor/depth.h"

namespace fathom {

double seen_disparity(const SensorModel& sensor, const Eigen::Vector2d& pixel_px, double depth) {
  if (!sensor.optics.distorts()) return disparity_of_depth(sensor, depth);
  const Eigen::Vector2d seen = (pixel_px - sensor.principal_px) / sensor.focal_px;
  const double nearer = sensor.baseline / depth - sensor.baseline / sensor.reference;
  const Eigen::Vector2d in_reference = sensor.optics.undistorted(seen) - Eigen::Vector2d(nearer, 0.0);
  return sensor.focal_px * (seen.x() - sensor.optics.distorted(in_reference).x() + sensor.baseline / sensor.reference);
}

double read_disparity(const SensorModel& sensor, const UnitError& error, double disparity_px) {
  const Calibration believed = sensor.calibration();
  const double at_reference = disparity_of_depth(sensor, sensor.reference);
  const double believed_there = believed.focal_px * believed.baseline / sensor.reference;
  return error.scale * disparity_px + error.offset_px + (believed_there - at_reference);
}

}  // namespace fathom
