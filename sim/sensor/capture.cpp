#include "sim/sensor/capture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/timed.h"
#include "sim/effects/effects_json.h"
#include "sim/render/intersect.h"
#include "sim/sensor/depth.h"

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

/// What this unit makes of disparities [px] in the frame of that number; 0 stays invalid.
void add_unit_error(const SensorModel& sensor, std::uint64_t frame, Image<float>& disparity) {
  const UnitError error = unit_error(sensor.unit, frame);
  const UnitMap* learned = sensor.unit.learned.map.get();
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x) {
      float& value = disparity(x, y);
      if (value <= 0.0f) continue;
      const double seen = value + (learned ? learned->camera_of(x, y) : 0.0f);
      value = static_cast<float>(std::max(read_disparity(sensor, error, seen), 0.0));
    }
}

/// Every disparity becomes the mean of those in a square of this width [px] around it that are of its own surface; at
/// the image's border of a narrower one, as a one-sided mean would be that of another place.
void average(double width_px, Image<float>& disparity) {
  const int reach = static_cast<int>(std::lround(0.5 * (width_px - 1.0)));
  if (reach < 1) return;
  const Image<float> own = disparity;
  parallel_rows(own.height(), [&](int y) {
    for (int x = 0; x < own.width(); ++x) {
      if (own(x, y) <= 0.0f) continue;
      const int across = std::min({reach, x, own.width() - 1 - x}), down = std::min({reach, y, own.height() - 1 - y});
      double sum = 0.0;
      int known = 0;
      for (int v = y - down; v <= y + down; ++v)
        for (int u = x - across; u <= x + across; ++u)
          if (own(u, v) > 0.0f && std::abs(own(u, v) - own(x, y)) < kOneSurfacePx) sum += own(u, v), ++known;
      disparity(x, y) = static_cast<float>(sum / known);
    }
  });
}

/// Depth and cloud as an application gets them that asks for them in the colour camera's image; what that image shows
/// is not simulated, so the points have no intensity.
void move_to_colour_view(const SensorModel& sensor, Frame& shot) {
  SensorModel colour = sensor;
  colour.believed = Calibration{sensor.baseline, kColourFocalPx, sensor.principal_px};
  shot.depth = registered_to_colour(shot.depth, sensor.focal_px, kColourFocalPx);
  shot.cloud = cloud_of_depth(colour, shot.depth, Image<float>(shot.depth.width(), shot.depth.height()));
}

/// Where the light goes that enters the media in and of cups.
enum class Scattering {
  none,
  within,
  at_the_surface  ///< of one of them, as if it were opaque
};

Scattering scattering_of(const Scene& scene) {
  // [1/m] of reduced scattering: from less than 0.05 mm deep light comes as from a surface, and walks take too long.
  constexpr double kSurface = 2e4;
  Scattering strongest = Scattering::none;
  const auto see = [&](const Medium& medium) {
    if (medium.scatters())
      strongest = std::max(strongest,
                           medium.reduced_scattering() >= kSurface ? Scattering::at_the_surface : Scattering::within);
  };
  for (const Cup& cup : scene.cups) {
    if (cup.filling) see(cup.filling->medium);
    if (const auto* shape = std::get_if<CupShape>(&cup.shape); shape && shape->material) see(*shape->material);
  }
  return strongest;
}

Eigen::Vector2d pixel_centre(int number, int width) { return {number % width + 0.5, number / width + 0.5}; }

}  // namespace

LightModel measured_light(const Setup& setup) {
  const Scattering scattering = scattering_of(setup.scene);
  if (scattering == Scattering::at_the_surface) return LightModel::direct;
  return setup.light.any() || scattering == Scattering::within ? LightModel::full : LightModel::direct;
}

LightModel ordinary_light(const Setup& setup, CaptureMode mode) {
  if (mode == CaptureMode::geometric) return measured_light(setup);
  const Scene& scene = setup.scene;
  if (scene.cups.empty() && scene.objects.empty()) return LightModel::direct;
  return scattering_of(scene) == Scattering::at_the_surface ? LightModel::direct : LightModel::full;
}

const std::vector<std::string>& light_names() {
  static const std::vector<std::string> names{"auto", "direct", "full"};
  return names;
}

std::optional<LightModel> light_named(const std::string& name) {
  if (name == "auto") return std::nullopt;
  if (name == "direct") return LightModel::direct;
  if (name == "full") return LightModel::full;
  throw Error(unknown_name("light", name, light_names()));
}

const char* name_of(LightModel light) {
  return light == LightModel::full ? "full" : light == LightModel::scattered ? "scattered" : "direct";
}

Camera::Camera(const Setup& setup, CaptureMode mode, int samples_per_pixel, std::uint64_t seed,
               std::optional<LightModel> light)
    : setup_(with_effects(setup)), mode_(mode), seed_(seed) {
  const SensorModel& sensor = setup_.rig.sensor;
  geometry_ = timed(statistics_.build_s, [&] { return build_geometry(setup_.scene, sensor.wavelength_nm); });
  const Intersector world(geometry_);
  const auto projector = timed(
      statistics_.build_s, [&] { return std::make_unique<const PointLight>(world, setup_.rig.projector_in_world()); });
  truth_ = timed(statistics_.truth_s, [&] { return trace_truth(*projector, setup_.rig); });
  statistics_.camera_rays = truth_.size();
  const LightModel ordinary = ordinary_light(setup_, mode);
  light_ = setup_.light.any() && ordinary == LightModel::full ? ordinary : light.value_or(ordinary);
  samples_across_ = static_cast<int>(std::ceil(std::sqrt(samples_per_pixel)));
  if (mode == CaptureMode::geometric) {
    if (light_ == LightModel::full)
      turbid_ = turbid_parts(*projector, setup_.rig, truth_, samples_across_, seed, statistics_);
    light_ = turbid_.empty() ? LightModel::direct : LightModel::scattered;
    if (turbid_.empty()) samples_across_ = 0;
    if (sensor.noise.disparity.present()) still_chance_ = block_chance(sensor, seed, kStill);
    const int margin = reference_margin(sensor.matcher);
    residue_ = reference_residue(sensor.unit, margin, sensor.width + 2 * margin, sensor.ir_height / 2);
    return;
  }
  Pattern pattern(sensor.pattern, sensor.ir_scale(), sensor.optics.projector_k1);
  auto reference = timed(statistics_.reference_s, [&] { return reference_image(sensor, pattern, samples_across_); });
  pattern.set_dot_gains(speckle_gains(sensor.noise, pattern, seed));
  view_.emplace(*projector, setup_.rig, pattern, std::move(reference), samples_across_, light_, seed, statistics_);
}

const Image<float>& Camera::radiance() const {
  static const Image<float> none;
  return view_ ? view_->radiance() : none;
}

Frame Camera::shoot(std::uint64_t frame) {
  return mode_ == CaptureMode::geometric ? shoot_geometric(frame) : shoot_photometric(frame);
}

Frame Camera::shoot_geometric(std::uint64_t frame) {
  const SensorModel& sensor = setup_.rig.sensor;
  Frame shot;
  shot.disparity_px = Image<float>(truth_.width(), truth_.height());
  Image<float> intensity(truth_.width(), truth_.height());
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    const TruePixel& pixel = truth_.pixels()[i];
    intensity.pixels()[i] = pixel.intensity;
    if (pixel.apparent_depth)
      shot.disparity_px.pixels()[i] = static_cast<float>(
          seen_disparity(sensor, pixel_centre(static_cast<int>(i), truth_.width()), *pixel.apparent_depth));
  }
  average(setup_.processing.window_px, shot.disparity_px);
  if (sensor.noise.disparity.present())
    shot.disparity_px =
        disparity_with_noise(sensor, shot.disparity_px, intensity, still_chance_, block_chance(sensor, seed_, frame));
  for (const TurbidPart& part : turbid_) {
    Image<float> matched = part.match(frame, statistics_);
    average(setup_.processing.window_px, matched);
    part.put(matched, truth_, shot.disparity_px);
  }
  add_residue(sensor, residue_, shot.disparity_px);
  add_unit_error(sensor, frame, shot.disparity_px);
  shot.depth = depth_image(sensor, shot.disparity_px, sensor.law.cut);
  shot.cloud = cloud_of_depth(sensor, shot.depth, intensity);
  if (setup_.processing.colour_view) move_to_colour_view(sensor, shot);
  return shot;
}

Frame Camera::shoot_photometric(std::uint64_t frame) {
  const SensorModel& sensor = setup_.rig.sensor;
  ImagedFrame imaged = view_->shoot(frame, statistics_);
  Frame shot;
  shot.ir = std::move(imaged.ir), shot.disparity_px = std::move(imaged.disparity_px);
  add_unit_error(sensor, frame, shot.disparity_px);
  shot.depth = timed(statistics_.depth_s, [&] { return depth_image(sensor, shot.disparity_px, sensor.law.cut); });
  shot.cloud = cloud_of_depth(sensor, shot.depth, at_depth_scale(sensor, shot.ir));
  if (setup_.processing.colour_view) move_to_colour_view(sensor, shot);
  return shot;
}

}  // namespace fathom
