#include "diagnosis/ray_traced/frame.h"

#include "sim/sensor/capture.h"

namespace fathom {
namespace {

constexpr int kShots = 2;

/// `weight`: pixels that each point stands for.
void add_points(const Image<CloudPoint>& cloud, float weight, std::vector<SensedPoint>& points) {
  for (const CloudPoint& p : cloud.pixels())
    if (p.z > 0.0f) points.push_back({{p.x, p.y, p.z}, p.intensity, weight});
}

}  // namespace

std::vector<SensedPoint> ray_traced_points(const Setup& setup, std::uint64_t seed) {
  Setup still = setup;
  still.rig.sensor.unit.wander_px = 0.0;
  Camera camera(still, CaptureMode::photometric, kDefaultSamplesPerPixel, seed);
  std::vector<SensedPoint> points;
  for (int shot = 0; shot < kShots; ++shot)
    add_points(camera.shoot(static_cast<std::uint64_t>(shot)).cloud, 1.0f / kShots, points);
  return points;
}

}  // namespace fathom
