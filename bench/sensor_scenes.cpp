#include "bench/sensor_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/bench_scene.h"
#include "core/json.h"
#include "core/median.h"
#include "core/units.h"

namespace fathom {
namespace {

Setup scene(const std::string& sensor, const std::string& more) {
  return setup_from_json(
      Json::parse(fmt::format(
          R"({{"sensor": {{"model": "kinect_v1_device", {}}}, "desk": {{"size_mm": [9000, 9000]}}{}}})", sensor, more)),
      "twin");
}

/// Where a sensor stands that looks at a wall; the desk is one.
std::string before_wall(double distance, double tilt_deg) {
  const double height_mm = mm_from_metres(distance) * std::cos(radians_from_deg(tilt_deg));
  return fmt::format(R"("height_mm": {}, "pitch_deg": {})", height_mm, 90.0 - tilt_deg);
}

}  // namespace

Setup desk_twin(const std::string& more) {
  return scene(R"("height_mm": 594, "pitch_deg": 34.47, "roll_deg": 0.07)", more);
}

Setup facing_wall(double distance, double tilt_deg) {
  return crop(scene(before_wall(distance, tilt_deg), ""), 640, 512);
}

Setup wall_with(double distance, const std::string& gltf, double z_mm, double tilt_deg) {
  return scene(before_wall(distance, tilt_deg),
               fmt::format(R"(, "objects": [{{"gltf": "{}", "position_mm": [0, {}, {}]}}])", gltf,
                           mm_from_metres(distance * std::sin(radians_from_deg(tilt_deg))), z_mm));
}

Frame shoot(const Setup& setup, std::uint64_t seed, CaptureMode mode) {
  return Camera(setup, mode, kDefaultSamplesPerPixel, seed).shoot(0);
}

double valid_share(const Image<float>& depth, int border) {
  int valid = 0;
  for (int y = border; y < depth.height() - border; ++y)
    for (int x = border; x < depth.width() - border; ++x) valid += depth(x, y) > 0.0f;
  return valid / static_cast<double>((depth.height() - 2 * border) * (depth.width() - 2 * border));
}

TemporalNoise temporal_noise(Camera& camera) {
  constexpr int kFrames = 16, kBorder = 4;
  std::vector<Image<float>> depths;
  double valid = 0.0;
  for (int frame = 0; frame < kFrames; ++frame) {
    depths.push_back(camera.shoot(static_cast<std::uint64_t>(frame)).depth);
    valid += valid_share(depths.back(), kBorder) / kFrames;
  }
  std::vector<double> deviations;
  double total = 0.0;
  for (std::size_t i = 0; i < depths[0].size(); ++i) {
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (const Image<float>& depth : depths) {
      const double z_mm = mm_from_metres(depth.pixels()[i]);
      sum += z_mm, squares += z_mm * z_mm, count += z_mm > 0.0;
    }
    if (count < 0.5 * kFrames) continue;
    deviations.push_back(std::sqrt(std::max(squares - sum * sum / count, 0.0) / (count - 1.0)));
    total += deviations.back();
  }
  if (deviations.empty()) return {0.0, 0.0, valid};
  const double mean = total / static_cast<double>(deviations.size());
  return {median(std::move(deviations)), mean, valid};
}

}  // namespace fathom
