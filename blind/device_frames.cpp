#include "blind/device_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/device_law.h"
#include "blind/laboratory.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

constexpr double kWarmUpSeconds = 600.0;

/// Normal, or of a tail that is heavy: Student's t of 4, scaled to the same variance.
double error_of(Rng& rng, bool heavy) {
  const double z = rng.normal();
  if (!heavy) return z;
  return z / std::sqrt(2.0 * rng.gamma(2.0, 2.0) / 4.0);  // chi² of 4 is Gamma(2, 2); t₄ has variance 2
}

/// Of each dot, drawn by `seed` and `stream`. `dot_px`: 1 σ of a dot whose Matched::dot_sigma is 1.
std::vector<double> dot_errors(const World& world, const Matched& matched, double dot_px, std::uint64_t seed,
                               std::uint64_t stream) {
  std::vector<double> errors(matched.dots.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    Rng rng(seed, stream, i);
    errors[i] = world.noise_scale * dot_px * matched.dot_sigma[i] * error_of(rng, world.heavy_tails);
  }
  return errors;
}

/// Adds what the errors of its dots make of a block's disparity.
void add_dot_errors(const Matched& matched, const Block& block, const std::vector<double>& errors, double& px) {
  for (int k = block.first; k < block.first + block.count; ++k)
    px += matched.members[k].error_weight * errors[matched.members[k].dot];
}

}  // namespace

Raster near_cup(const Placement& placement) {
  // Pixels of the box about the cup, as the laboratory aims.
  const World world = believed(placement);
  const Eyes eyes = eyes_of(world.sensor);
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  const double half = world.cup.outer_radius + 0.012;
  for (const double dx : {-half, half})
    for (const double dy : {-half, half})
      for (const double z : {0.0, world.cup.height}) {
        const Eigen::Vector3d corner(world.cup.centre.x() + dx, world.cup.centre.y() + dy, z);
        const Eigen::Vector2d pixel = camera_pixel(eyes, world.sensor, corner - eyes.camera);
        low = low.cwiseMin(pixel);
        high = high.cwiseMax(pixel);
      }
  const Eigen::Vector2i border(4, 4);  // half a window
  return {low.array().floor().matrix().cast<int>().cwiseMax(border),
          high.array().ceil().matrix().cast<int>().cwiseMin(Eigen::Vector2i(640, 480) - border), 2};
}

double field_px(const World& world, const Eigen::Vector2d& pixel, double disparity_px) {
  const Eigen::Vector2d off = pixel - Eigen::Vector2d(320, 240);
  const Eigen::Vector2d from_patch = pixel - world.strange.lens_patch_at;
  const double nearer_px = disparity_px - kDisparityMm / kReferenceMm;
  double px = unit_px(world.unit, pixel - Eigen::Vector2d(nearer_px, 0.0));
  px += world.dust.pattern_bend_px * off.squaredNorm() / (400.0 * 400.0);
  px += world.dust.band_px * (static_cast<int>(pixel.y()) / 16 % 2 == 0 ? 1.0 : -1.0);
  if (world.strange.lens_patch_px != 0.0)
    px += world.strange.lens_patch_px * std::exp(-0.5 * from_patch.squaredNorm() / (40.0 * 40.0));
  if (world.strange.rolling_px != 0.0)
    px += world.strange.rolling_px * std::sin(2.0 * std::numbers::pi * pixel.y() / 260.0 + world.strange.rolling_phase);
  return px;
}

Raster whole_image() { return {{4, 4}, {636, 476}, 12}; }

Scene stand(const World& world, const std::vector<Dot>& dots, bool has_cup, const Raster& raster,
            std::uint64_t standing) {
  Scene scene{match(world, dots, has_cup, raster, standing), {}, {}};
  const Matched& matched = scene.matched;
  const std::vector<double> errors = dot_errors(world, matched, kStaticDotPx, standing, 0x57a7);
  for (const Block& block : matched.blocks) {
    double px = field_px(world, block.pixel, block.disparity_px);
    add_dot_errors(matched, block, errors, px);
    scene.standing_px.push_back(px);
  }
  scene.dn = infrared_dn(matched);
  return scene;
}

Shake shake_of(const World& world, std::uint64_t frame) {
  Rng rng(frame, 0x5a4e);
  const double wander = std::hypot(0.003 * world.noise_scale, world.wander_px) * rng.normal();
  return {wander + world.warm_up_px * std::exp(-world.seconds / kWarmUpSeconds),
          2.0 * std::numbers::pi * rng.uniform()};
}

std::vector<double> disparities(const Scene& scene, const World& world, const Shake& shake, std::uint64_t frame) {
  const Matched& matched = scene.matched;
  const std::vector<double> errors = dot_errors(world, matched, kTemporalDotPx, frame, 0x7e39);
  std::vector<double> result;
  result.reserve(matched.blocks.size());
  for (std::size_t b = 0; b < matched.blocks.size(); ++b) {
    const Block& block = matched.blocks[b];
    double px = block.disparity_px + scene.standing_px[b] + shake.offset_px;
    add_dot_errors(matched, block, errors, px);
    if (world.strange.vibration_px != 0.0)
      px += world.strange.vibration_px * std::sin(2.0 * std::numbers::pi * block.pixel.y() / 180.0 + shake.phase);
    result.push_back(px);
  }
  return result;
}

void append_points(const Scene& scene, const World& world, const Shake& shake, std::uint64_t frame,
                   const Raster* but_not_in, std::vector<CloudPoint>& cloud) {
  const std::vector<double> px = disparities(scene, world, shake, frame);
  Rng camera(frame, 0x4ead);
  for (std::size_t b = 0; b < px.size(); ++b) {
    const Eigen::Vector2d& pixel = scene.matched.blocks[b].pixel;
    const double dn = std::max(0.0, scene.dn[b] + 3.0 * camera.normal());  // read noise
    if (but_not_in && (pixel.array() >= but_not_in->low.cast<double>().array()).all() &&
        (pixel.array() < but_not_in->high.cast<double>().array()).all())
      continue;
    const Eigen::Vector3f p = cloud_point(pixel, device_depth(px[b], world.sensor.steps_per_px)).cast<float>();
    cloud.push_back({p.x(), p.y(), p.z(), static_cast<float>(std::min(1023.0, dn))});
  }
}

}  // namespace fathom::blind
