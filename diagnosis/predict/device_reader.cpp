#include "diagnosis/predict/device_reader.h"

namespace fathom {
namespace {

/// Nothing of these is in a mean: noise, how the law's depths are rounded, and the unit, whose error is read apart.
Rig without_noise(Rig rig) {
  const SensorModel ideal;
  rig.sensor.noise = ideal.noise;
  rig.sensor.law.step_phase = ideal.law.step_phase;
  rig.sensor.law.cut = ideal.law.cut;
  rig.sensor.unit = ideal.unit;
  return rig;
}

UnitError without_wander(UnitModel unit) {
  unit.wander_px = 0.0;
  return unit_error(unit, 0);
}

}  // namespace

DeviceReader::DeviceReader(const Setup& setup)
    : rig_(without_noise(setup.rig)),
      error_(without_wander(setup.rig.sensor.unit)),
      window_px_(setup.processing.window_px),
      aside_m_(setup.processing.colour_view ? kColourCamera : 0.0) {}

std::optional<SensedPoint> DeviceReader::point_read(const Eigen::Vector2d& pixel, double disparity_px, double reflected,
                                                    double weight) const {
  constexpr double kHalfCode_px = 1.0 / 16.0;  // by which the middle of an even number of codes is no code
  const SensorModel& sensor = rig_.sensor;
  const double read = read_disparity(sensor, error_, disparity_px);
  const double read_as = sensor.law.quantized && sensor.law.codes_per_step % 2 == 0 ? read - kHalfCode_px : read;
  if (read_as <= 0.0) return std::nullopt;
  constexpr double kCutOff = 0.5 * kMetresPerMm;  // depths are cut to whole millimetres
  const double z = depth_of_disparity(sensor, read_as) - (sensor.law.quantized ? kCutOff : 0.0);
  const Calibration calibration = sensor.calibration();
  const Eigen::Vector2d across = z / calibration.focal_px * (pixel - calibration.principal_px);
  return SensedPoint{Eigen::Vector3d(across.x() - aside_m_, across.y(), z).cast<float>(),
                     static_cast<float>(radiance_dn(sensor, reflected)), static_cast<float>(weight)};
}

}  // namespace fathom
