#include "sim/sensor/glints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/render/glint.h"
#include "sim/render/radiance.h"

namespace fathom {
namespace {

/// Share of a Gaussian about `centre` that falls between `from` and `from` + 1.
double share_in_pixel(double from, double centre, double sigma) {
  const auto above = [&](double edge) { return std::erfc((edge - centre) / (std::numbers::sqrt2 * sigma)); };
  return 0.5 * (above(from) - above(from + 1.0));
}

void add_spot(const Eigen::Vector2d& centre_px, double sigma_px, double sum, Image<float>& image) {
  const double reach = 6.0 * sigma_px;  // a billionth of the power lies beyond
  const Eigen::Array2d size_px(image.width(), image.height());
  if ((centre_px.array() < -reach || centre_px.array() > size_px + reach).any()) return;
  const auto first = [&](double centre) { return std::max(static_cast<int>(std::floor(centre - reach)), 0); };
  const auto last = [&](double centre, int size) {
    return std::min(static_cast<int>(std::floor(centre + reach)), size - 1);
  };
  for (int y = first(centre_px.y()); y <= last(centre_px.y(), image.height()); ++y)
    for (int x = first(centre_px.x()); x <= last(centre_px.x(), image.width()); ++x)
      image(x, y) += static_cast<float>(sum * share_in_pixel(x, centre_px.x(), sigma_px) *
                                        share_in_pixel(y, centre_px.y(), sigma_px));
}

}  // namespace

void add_glints(const PointLight& projector, const Rig& rig, const Pattern& pattern, Image<float>& image) {
  const SensorModel& sensor = rig.sensor;
  const double focal_ir_px = sensor.ir_scale() * sensor.focal_px;
  for (const Connection& way : find_glints(projector.world(), projector.source(), rig.camera_in_world())) {
    const auto at = rig.rectified(-way.arrival);
    if (!at) continue;
    const Eigen::Vector2d centre_ir_px =
        sensor.ir_scale() * sensor.principal_px + focal_ir_px * *at + Eigen::Vector2d(0.0, sensor.ir_first_row());
    // What the pinhole receives of a square metre [W/m²] is radiance times the pixels' solid angles.
    const double irradiance = way.spreading * way.transmittance * intensity_towards(pattern, rig, way.direction);
    const double pixel = std::pow(at->homogeneous().normalized().z(), 3.0) / (focal_ir_px * focal_ir_px);
    add_spot(centre_ir_px, sensor.pattern.dot_sigma_ir_px, radiance_dn(sensor, std::numbers::pi * irradiance / pixel),
             image);
  }
}

}  // namespace fathom
