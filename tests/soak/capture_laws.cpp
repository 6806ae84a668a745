#include "tests/soak/capture_laws.h"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace

std::vector<std::string> broken_capture_laws(const SensorModel& sensor, const Camera& camera, const Frame& frame) {
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
  laws.of_pixels("the infrared image is finite", frame.ir, finite);
  if (!frame.ir.empty()) laws.of_size("the infrared image is whole", frame.ir, sensor.ir_width, sensor.ir_height);

  laws.of_size("the depth image is whole", frame.depth, sensor.width, sensor.height);
  laws.of_pixels("disparity is finite and not negative", frame.disparity_px, a_power);
  // Half a millimetre: floats of at most 10 m are rounded far below it, whole mm of the device far above.
  laws.of_pixels("depth is in range or invalid", frame.depth, [&](float depth) {
    constexpr float kRounding = 1e-6f;
    return depth == 0.0f || (depth >= static_cast<float>(sensor.near) * (1.0f - kRounding) &&
                             depth <= static_cast<float>(sensor.far) * (1.0f + kRounding));
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
