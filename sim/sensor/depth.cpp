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

Image<std::uint16_t> shift_image(const SensorModel& sensor, const Image<float>& disparity_px) {
  const Image<float> depth = depth_image(sensor, disparity_px);
  Image<std::uint16_t> shifts(depth.width(), depth.height(), kNoShift);
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (depth.pixels()[i] == 0.0f) continue;
    // From the disparity, not from the depth, which has lost up to a millimetre.
    const double exact_depth = depth_of_disparity(sensor, disparity_px.pixels()[i]);
    const int shift = device_code(sensor, exact_depth) + kShiftOfCodeZero;
    if (shift >= 0 && shift < kNoShift) shifts.pixels()[i] = static_cast<std::uint16_t>(shift);
  }
  return shifts;
}

Image<float> registered_to_colour(const Image<float>& depth, double focal_px, double colour_focal_px) {
  Image<float> registered(depth.width(), depth.height());
  const double middle_x = 0.5 * depth.width(), middle_y = 0.5 * depth.height(), scale = colour_focal_px / focal_px;
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x) {
      const float z = depth(x, y);
      if (z <= 0.0f) continue;
      const double moved_px = colour_focal_px * kColourCamera / z;
      const int column = static_cast<int>(std::floor((x + 0.5 - middle_x) * scale - moved_px + middle_x));
      const int row = static_cast<int>(std::floor((y + 0.5 - middle_y) * scale + middle_y));
      if (column < 0 || row < 0 || column >= registered.width() || row >= registered.height()) continue;
      float& nearest = registered(column, row);
      if (nearest == 0.0f || z < nearest) nearest = z;
    }
  return registered;
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
