#include "sim/sensor/capture.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/timed.h"
#include "sim/render/intersect.h"
#include "sim/sensor/depth.h"
#include "sim/sensor/match.h"
#include "sim/sensor/speckle.h"

namespace fathom {
namespace {

// Keys of what is drawn for a geometric capture; those of the frames are their numbers.
constexpr std::uint64_t kStill = ~std::uint64_t{0};

/// What a displaced reference adds to disparities [px]: a pixel meets it as far to the side as it is nearer.
void add_residue(const SensorModel& sensor, const Image<float>& residue, Image<float>& disparity) {
  if (residue.empty()) return;
  const int margin = reference_margin(sensor.matcher);
  const double at_reference = disparity_of_depth(sensor, sensor.reference);
  const int first_row = sensor.ir_first_row() / 2;
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x) {
      float& value = disparity(x, y);
      if (value <= 0.0f) continue;
      const int met = x + margin - static_cast<int>(std::lround(value - at_reference));
      value = std::max(value + residue(std::clamp(met, 0, residue.width() - 1), y + first_row), 0.0f);
    }
}

/// What this unit makes of disparities [px]; 0 stays invalid.
void misread(const UnitError& error, Image<float>& disparity) {
  for (float& value : disparity.pixels())
    if (value > 0.0f) value = static_cast<float>(std::max(error.scale * value + error.offset_px, 0.0));
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
  if (mode == CaptureMode::geometric) {
    if (sensor.noise.disparity.present()) still_chance_ = block_chance(sensor, seed, kStill);
    const int margin = reference_margin(sensor.matcher);
    residue_ = reference_residue(sensor.unit, margin, sensor.width + 2 * margin, sensor.ir_height / 2);
    return;
  }

  samples_across_ = static_cast<int>(std::ceil(std::sqrt(samples_per_pixel)));
  Pattern pattern(sensor.pattern, sensor.ir_scale(), sensor.optics.projector_k1);
  reference_ = timed(statistics_.reference_s, [&] { return remembered(sensor, pattern, samples_across_); });
  pattern.set_dot_gains(speckle_gains(sensor.noise, pattern, seed));
  radiance_ =
      timed(statistics_.render_s, [&] { return render_ir(*projector, rig_, pattern, samples_across_, light, seed); });
  statistics_.camera_rays += radiance_.size() * samples_across_ * samples_across_;
  speckle_ = speckle_field(sensor, sensor.noise.pixel_speckle, sensor.ir_width, sensor.ir_height, seed);
  if (sensor.noise.ambient_dn > 0.0) ambient_ = render_ambient(world, rig_);
}

Frame Camera::shoot(std::uint64_t frame) {
  return mode_ == CaptureMode::geometric ? shoot_geometric(frame) : shoot_photometric(frame);
}

Frame Camera::shoot_geometric(std::uint64_t frame) {
  Frame shot;
  shot.disparity_px = Image<float>(truth_.width(), truth_.height());
  Image<float> intensity(truth_.width(), truth_.height());
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    const TruePixel& pixel = truth_.pixels()[i];
    intensity.pixels()[i] = static_cast<float>(pixel.intensity);
    if (pixel.apparent_depth)
      shot.disparity_px.pixels()[i] = static_cast<float>(disparity_of_depth(rig_.sensor, *pixel.apparent_depth));
  }
  if (rig_.sensor.noise.disparity.present())
    shot.disparity_px = disparity_with_noise(rig_.sensor, shot.disparity_px, intensity, still_chance_,
                                             block_chance(rig_.sensor, seed_, frame));
  add_residue(rig_.sensor, residue_, shot.disparity_px);
  misread(unit_error(rig_.sensor.unit, frame), shot.disparity_px);
  shot.depth = depth_image(rig_.sensor, shot.disparity_px);
  shot.cloud = cloud_of_depth(rig_.sensor, shot.depth, intensity);
  return shot;
}

Frame Camera::shoot_photometric(std::uint64_t frame) {
  const SensorModel& sensor = rig_.sensor;
  Frame shot;
  Image<float> light = radiance_;
  add_speckle(renewed_speckle(sensor, speckle_, seed_, frame), light);
  for (std::size_t i = 0; i < ambient_.size(); ++i) light.pixels()[i] += ambient_.pixels()[i];
  shot.ir = expose(light, sensor.noise, seed_, frame);
  shot.disparity_px = timed(statistics_.match_s, [&] { return match(sensor, shot.ir, *reference_).disparity_px; });
  misread(unit_error(sensor.unit, frame), shot.disparity_px);
  shot.depth = timed(statistics_.depth_s, [&] { return depth_image(sensor, shot.disparity_px); });
  shot.cloud = cloud_of_depth(sensor, shot.depth, at_depth_scale(sensor, shot.ir));
  return shot;
}

}  // namespace fathom
