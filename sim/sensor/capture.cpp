#include "sim/sensor/capture.h"

#include <chrono>
#include <cmath>
#include <memory>

#include "sim/render/intersect.h"
#include "sim/sensor/depth.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

/// Runs `work` and adds its wall-clock time.
template <class Work>
auto timed(double& seconds, Work work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace

Camera::Camera(const Setup& setup, CaptureMode mode, int samples_per_pixel, std::uint64_t seed, LightModel light)
    : rig_(setup.rig), mode_(mode), seed_(seed) {
  const SensorModel& sensor = rig_.sensor;
  geometry_ = timed(statistics_.build_s, [&] { return build_geometry(setup.scene, sensor.wavelength_nm); });
  const Intersector world(geometry_);
  const auto projector =
      timed(statistics_.build_s, [&] { return std::make_unique<const PointLight>(world, rig_.projector_in_world()); });
  truth_ = timed(statistics_.truth_s, [&] { return trace_truth(*projector, rig_); });
  statistics_.camera_rays = truth_.size();
  if (mode == CaptureMode::geometric) return;

  samples_across_ = static_cast<int>(std::ceil(std::sqrt(samples_per_pixel)));
  Pattern pattern(sensor.pattern, sensor.ir_scale());
  const int margin = reference_margin(sensor.matcher);
  reference_ = timed(statistics_.reference_s, [&] {
    return memorise(sensor, reference_image(sensor, pattern, margin, samples_across_), margin);
  });
  pattern.set_dot_gains(speckle_gains(sensor.noise, pattern, seed));
  radiance_ =
      timed(statistics_.render_s, [&] { return render_ir(*projector, rig_, pattern, samples_across_, light, seed); });
  statistics_.camera_rays += radiance_.size() * samples_across_ * samples_across_;
}

Frame Camera::shoot(std::uint64_t frame) {
  return mode_ == CaptureMode::geometric ? shoot_geometric() : shoot_photometric(frame);
}

Frame Camera::shoot_geometric() {
  Frame shot;
  shot.disparity_px = Image<float>(truth_.width(), truth_.height());
  Image<float> intensity(truth_.width(), truth_.height());
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    const TruePixel& pixel = truth_.pixels()[i];
    intensity.pixels()[i] = static_cast<float>(pixel.intensity);
    if (pixel.apparent_depth)
      shot.disparity_px.pixels()[i] = static_cast<float>(disparity_of_depth(rig_.sensor, *pixel.apparent_depth));
  }
  shot.depth = depth_image(rig_.sensor, shot.disparity_px);
  shot.cloud = cloud_of_depth(rig_.sensor, shot.depth, intensity);
  return shot;
}

Frame Camera::shoot_photometric(std::uint64_t frame) {
  const SensorModel& sensor = rig_.sensor;
  Frame shot;
  shot.ir = expose(radiance_, sensor.noise, seed_, frame);
  shot.disparity_px = timed(statistics_.match_s, [&] { return match(sensor, shot.ir, reference_).disparity_px; });
  shot.depth = timed(statistics_.depth_s, [&] { return depth_image(sensor, shot.disparity_px); });
  shot.cloud = cloud_of_depth(sensor, shot.depth, at_depth_scale(sensor, shot.ir));
  return shot;
}

}  // namespace fathom
