#include "diagnosis/measurement/calibrated_unit.h"

#include "core/json.h"
#include "core/units.h"
#include "diagnosis/measurement/unit_bias.h"

namespace fathom {

namespace {

DeviceScale scale_of(const std::filesystem::path& file) {
  const Json json = read_json(file);
  const JsonReader device = JsonReader(json, file).at("device");
  device.allow_only({"focal_px", "baseline_mm", "image_focal_px", "camera_mm"});
  DeviceScale scale;
  scale.focal_px = device.number("focal_px", {1.0, 1e6});
  scale.baseline_m = metres_from_mm(device.number("baseline_mm", {1.0, 1e4}));
  scale.camera_m = metres_from_mm(device.number("camera_mm", {-1e3, 1e3}));
  return scale;
}

}  // namespace

CalibratedUnit::CalibratedUnit(const std::filesystem::path& file)
    : unit_(read_learned_unit(file)), scale_(scale_of(file)) {}

void CalibratedUnit::take_off_bias(std::span<Eigen::Vector3f> points) const {
  const double of_inverse = scale_.focal_px * scale_.baseline_m;
  const Bias bias = as_bias(*unit_.map);
  for (Eigen::Vector3f& point : points) {
    if (!(point.z() > 0.0f)) continue;  // NaN as well
    point *= stretch_without(bias, bias_point(point, scale_), of_inverse, point.z());
  }
}

}  // namespace fathom
