#include "sim/sensor/depth.h"

#include <cmath>
#include <limits>

namespace fathom {
namespace {

/// 8 f b [mm]: how many steps of 1/8 px a change of inverse depth by 1/mm makes.
double steps_per_inverse_mm(const SensorModel& sensor) {
  const Calibration calibration = sensor.calibration();
  return 8.0 * calibration.focal_px * mm_from_metres(calibration.baseline);
}

}  // namespace

std::optional<double> device_depth(const SensorModel& sensor, int code, double unit) {
  const double inverse_mm =
      1.0 / mm_from_metres(sensor.reference) - (code + sensor.step_phase) / steps_per_inverse_mm(sensor);
  if (inverse_mm <= 0.0) return std::nullopt;
  const double unit_mm = mm_from_metres(unit);
  return metres_from_mm(unit_mm > 0.0 ? std::floor(1.0 / inverse_mm / unit_mm) * unit_mm : 1.0 / inverse_mm);
}

double cut_of(const SensorModel& sensor, double unit) { return sensor.cut / kMetresPerMm * unit; }

int device_code(const SensorModel& sensor, double depth) {
  const double inverse_mm = 1.0 / mm_from_metres(depth);
  const double code =
      steps_per_inverse_mm(sensor) * (1.0 / mm_from_metres(sensor.reference) - inverse_mm) - sensor.step_phase;
  const int together = sensor.codes_per_step;
  return together * static_cast<int>(std::floor((code + 0.5) / together)) + together / 2;
}

double disparity_of_depth(const SensorModel& sensor, double depth) { return sensor.focal_px * sensor.baseline / depth; }

double depth_of_disparity(const SensorModel& sensor, double disparity_px) {
  const Calibration calibration = sensor.calibration();
  return calibration.focal_px * calibration.baseline / disparity_px;
}

Image<float> depth_image(const SensorModel& sensor, const Image<float>& disparity_px, double unit) {
  Image<float> depth(disparity_px.width(), disparity_px.height());
  std::optional<int> last_code;  // neighbours often share one
  std::optional<double> of_last_code;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double disparity = disparity_px.pixels()[i];
    if (disparity <= 0.0) continue;
    std::optional<double> z = depth_of_disparity(sensor, disparity);
    if (sensor.quantized) {
      const int code = device_code(sensor, *z);
      if (last_code != code) last_code = code, of_last_code = device_depth(sensor, code, unit);
      z = of_last_code;
    }
    if (z && *z >= sensor.near && *z <= sensor.far) depth.pixels()[i] = static_cast<float>(*z);
  }
  return depth;
}

Image<std::uint16_t> depth_in_units(const Image<float>& depth, double unit) {
  Image<std::uint16_t> whole(depth.width(), depth.height());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const long units = std::lround(depth.pixels()[i] / unit);
    if (units <= std::numeric_limits<std::uint16_t>::max()) whole.pixels()[i] = static_cast<std::uint16_t>(units);
  }
  return whole;
}

Image<CloudPoint> cloud_of_depth(const SensorModel& sensor, const Image<float>& depth, const Image<float>& intensity) {
  constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
  const Calibration calibration = sensor.calibration();
  Image<CloudPoint> cloud(depth.width(), depth.height());
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x) {
      const double z = depth(x, y);
      CloudPoint& point = cloud(x, y);
      point = {kInvalid, kInvalid, kInvalid, intensity(x, y)};
      if (z <= 0.0) continue;
      point.x = static_cast<float>(z * (x + 0.5 - calibration.principal_px.x()) / calibration.focal_px);
      point.y = static_cast<float>(z * (y + 0.5 - calibration.principal_px.y()) / calibration.focal_px);
      point.z = static_cast<float>(z);
    }
  return cloud;
}

}  // namespace fathom
