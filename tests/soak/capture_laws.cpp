#include "tests/soak/capture_laws.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/render/radiance.h"

namespace fathom {
namespace {

class Laws {
 public:
  /// Every pixel of an image obeys a law; of those that do not, the first is named.
  template <class T, class Holds>
  void of_pixels(const char* law, const Image<T>& image, Holds holds) {
    int breaches = 0, first_x = 0, first_y = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (!holds(image(x, y)) && breaches++ == 0) first_x = x, first_y = y;
    if (breaches > 0)
      broken.push_back(
          fmt::format("{}: not so in {} of {} pixels, e.g. ({}, {})", law, breaches, image.size(), first_x, first_y));
  }
  template <class T>
  void of_size(const char* law, const Image<T>& image, int width, int height) {
    if (image.width() != width || image.height() != height)
      broken.push_back(fmt::format("{}: {}×{} instead of {}×{}", law, image.width(), image.height(), width, height));
  }

  std::vector<std::string> broken;
};

bool finite(float value) { return std::isfinite(value); }
bool a_power(double value) { return std::isfinite(value) && value >= 0.0; }

/// Greatest intensity of the pattern: no two dots are adjacent, so of 2 × 2 positions at most one holds a dot, and of
/// two neighbouring pairs of columns one is at least half a step away; likewise of rows.
double most_intensity(const SensorModel& sensor) {
  const double half_step_ir_px = 0.5 * sensor.ir_scale() * sensor.pattern.step_px;
  const double share = half_step_ir_px / sensor.pattern.dot_sigma_ir_px;
  const double across = 1.0 + std::exp(-0.5 * share * share);
  return across * across;
}

/// Upper bound of every pixel's radiance [DN]: white, facing the projector, as near as the nearest surface. Going into
/// a denser medium through a level surface light only spreads, and its intensity along the ray falls; any other surface
/// may focus it, and a glaze's highlight is brighter than white. Speckle has no bound, and light by several ways adds
/// up.
std::optional<double> most_radiance(const Rig& rig, const Geometry& geometry, LightModel light) {
  if (rig.sensor.noise.speckle_shape > 0.0 || light == LightModel::full) return std::nullopt;
  for (const Body& body : geometry.bodies)
    if (!body.plain) return std::nullopt;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Surface& surface : geometry.surfaces) {
    if (std::holds_alternative<Glazed>(surface.optics)) return std::nullopt;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : surface.mesh.vertices) box.extend(vertex);
    nearest = std::min(nearest, box.exteriorDistance(rig.projector_in_world()));
  }
  if (nearest == 0.0) return std::nullopt;
  return radiance_dn(rig.sensor, 1.0 / (nearest * nearest)) * most_intensity(rig.sensor);
}

}  // namespace

std::vector<std::string> broken_capture_laws(const Rig& rig, const Camera& camera, LightModel light,
                                             const Frame& frame) {
  const SensorModel& sensor = rig.sensor;
  Laws laws;
  const int objects = static_cast<int>(camera.geometry().objects.size());
  laws.of_size("the truth has the depth image's size", camera.truth(), sensor.width, sensor.height);
  laws.of_pixels("a true pixel is finite", camera.truth(), [&](const TruePixel& pixel) {
    const bool depth = !pixel.apparent_depth || (std::isfinite(*pixel.apparent_depth) && *pixel.apparent_depth > 0.0);
    return pixel.position.allFinite() && a_power(pixel.intensity) && depth;
  });
  laws.of_pixels("a true pixel sees an object of the scene or nothing", camera.truth(), [&](const TruePixel& pixel) {
    const bool nothing = pixel.path == PathKind::nothing;
    return nothing ? pixel.object == 0 : pixel.object >= 1 && pixel.object <= objects;
  });

  laws.of_pixels("radiance is finite and not negative", camera.radiance(), a_power);
  if (const auto most = most_radiance(rig, camera.geometry(), light))
    laws.of_pixels("no pixel is brighter than white at the nearest surface", camera.radiance(), [&](float radiance) {
      constexpr double kRounding = 1e-6;  // of pixels, and of the pattern's profile, to float
      return radiance <= *most * (1.0 + kRounding);
    });
  laws.of_pixels("the infrared image is finite", frame.ir, finite);
  if (!frame.ir.empty()) laws.of_size("the infrared image is whole", frame.ir, sensor.ir_width, sensor.ir_height);

  laws.of_size("the depth image is whole", frame.depth, sensor.width, sensor.height);
  laws.of_pixels("disparity is finite and not negative", frame.disparity_px, a_power);
  laws.of_pixels("depth is in range or invalid", frame.depth, [&](float depth) {
    constexpr float kRounding = 1e-6f;  // of depths to float
    return depth == 0.0f || (depth >= static_cast<float>(sensor.law.near) * (1.0f - kRounding) &&
                             depth <= static_cast<float>(sensor.law.far) * (1.0f + kRounding));
  });
  Image<int> agrees(sensor.width, sensor.height);
  for (std::size_t i = 0; i < agrees.size(); ++i) {
    const CloudPoint& point = frame.cloud.pixels()[i];
    const float depth = frame.depth.pixels()[i];
    agrees.pixels()[i] = depth > 0.0f ? point.z == depth && finite(point.x) && finite(point.y)
                                      : std::isnan(point.x) && std::isnan(point.y) && std::isnan(point.z);
    agrees.pixels()[i] =
        agrees.pixels()[i] && finite(point.intensity) && (depth == 0.0f || frame.disparity_px.pixels()[i] > 0.0f);
  }
  laws.of_pixels("cloud, depth and disparity agree about what is valid", agrees, [](int same) { return same != 0; });
  return laws.broken;
}

}  // namespace fathom
