#include "sim/sensor/depth.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/simd.h"

namespace fathom {
namespace {

/// The device's steps of disparity, of depths in mm.
class StepLaw {
 public:
  explicit StepLaw(const SensorModel& sensor)
      : inverse_reference_(1.0 / mm_from_metres(sensor.reference)),
        phase_(sensor.law.step_phase),
        together_(sensor.law.codes_per_step) {
    const Calibration calibration = sensor.calibration();
    steps_per_inverse_mm_ = 8.0 * calibration.focal_px * mm_from_metres(calibration.baseline);
  }

  /// [1/mm]
  double inverse_of(int code) const { return inverse_reference_ - (code + phase_) / steps_per_inverse_mm_; }
  /// The nearest code, or the middle one of those that come together.
  int code_of(double inverse_mm) const {
    const double code = steps_per_inverse_mm_ * (inverse_reference_ - inverse_mm) - phase_;
    return together_ * static_cast<int>(std::floor((code + 0.5) / together_)) + together_ / 2;
  }

 private:
  double inverse_reference_, phase_, steps_per_inverse_mm_ = 0.0;
  int together_;
};

/// [m]; cut to whole units, or not where `unit_mm` is 0.
std::optional<double> depth_of(const StepLaw& law, int code, double unit_mm) {
  const double inverse_mm = law.inverse_of(code);
  if (inverse_mm <= 0.0) return std::nullopt;
  return metres_from_mm(unit_mm > 0.0 ? std::floor(1.0 / inverse_mm / unit_mm) * unit_mm : 1.0 / inverse_mm);
}

/// The codes of a row of disparities [px]; of those that are no number above 0 anything.
FATHOM_SIMD_CLONES
void codes_of(const StepLaw& law, double focal_baseline_mm, const float* __restrict disparity_px, int* __restrict codes,
              int count) {
  for (int i = 0; i < count; ++i) codes[i] = law.code_of(disparity_px[i] / focal_baseline_mm);
}

}  // namespace

std::optional<double> device_depth(const SensorModel& sensor, int code, double unit) {
  return depth_of(StepLaw(sensor), code, mm_from_metres(unit));
}

double cut_of(const SensorModel& sensor, double unit) { return sensor.law.cut / kMetresPerMm * unit; }

int device_code(const SensorModel& sensor, double depth) {
  return StepLaw(sensor).code_of(1.0 / mm_from_metres(depth));
}

double disparity_of_depth(const SensorModel& sensor, double depth) { return sensor.focal_px * sensor.baseline / depth; }

double depth_of_disparity(const SensorModel& sensor, double disparity_px) {
  const Calibration calibration = sensor.calibration();
  return calibration.focal_px * calibration.baseline / disparity_px;
}

Image<float> depth_image(const SensorModel& sensor, const Image<float>& disparity_px, double unit) {
  Image<float> depth(disparity_px.width(), disparity_px.height());
  const StepLaw law(sensor);
  const Calibration calibration = sensor.calibration();
  const double focal_baseline = calibration.focal_px * calibration.baseline, unit_mm = mm_from_metres(unit);
  std::vector<int> codes(static_cast<std::size_t>(depth.width()));
  int last_code = 0;  // neighbours often share one
  std::optional<double> of_last_code = depth_of(law, last_code, unit_mm);
  for (int y = 0; y < depth.height(); ++y) {
    const float* disparity = disparity_px.row(y);
    if (sensor.law.quantized) codes_of(law, mm_from_metres(focal_baseline), disparity, codes.data(), depth.width());
    for (int x = 0; x < depth.width(); ++x) {
      if (!(disparity[x] > 0.0f)) continue;
      std::optional<double> z;
      if (sensor.law.quantized) {
        const int code = codes[static_cast<std::size_t>(x)];
        if (last_code != code) last_code = code, of_last_code = depth_of(law, code, unit_mm);
        z = of_last_code;
      } else {
        z = focal_baseline / disparity[x];
      }
      if (z && *z >= sensor.law.near && *z <= sensor.law.far) depth(x, y) = static_cast<float>(*z);
    }
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
