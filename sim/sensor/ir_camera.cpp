#include "sim/sensor/ir_camera.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/rng.h"
#include "sim/render/connection.h"
#include "sim/render/radiance.h"
#include "sim/render/truth.h"
#include "sim/render/turbid.h"
#include "sim/sensor/pixel_mean.h"

namespace fathom {
namespace {

constexpr std::uint64_t kSpeckleStream = 0x737065636bULL;
constexpr std::uint64_t kDetectorStream = 0x6465746563ULL;
constexpr std::uint64_t kWalkStream = 0x77616c6bULL;

/// Walks per camera ray that enters a scattering body.
constexpr int kWalks = 4;

/// Radiance [DN] along one camera ray; `rng` is for light that walks through scattering bodies.
double sample_radiance(const PointLight& projector, const Rig& rig, const Pattern& pattern, const Ray& ray,
                       TurbidModel turbid, Rng rng) {
  const std::optional<SeenPoint> seen = see(projector.world(), ray);
  if (!seen) return 0.0;
  const auto intensity = [&](const Eigen::Vector3d& direction) {
    const auto at = rectified(rig, direction);
    return at ? pattern.intensity(at->x(), at->y(), rig.sensor.focal_px) : 0.0;
  };
  double radiance = 0.0;
  if (!seen->entered || turbid == TurbidModel::surface) {
    for_each_illumination(projector, *seen, [&](const Illumination& light) {
      radiance += radiance_dn(rig.sensor, *seen, light) * intensity(light.direction);
    });
    return radiance;
  }
  for (int walk = 0; walk < kWalks; ++walk)
    walk_turbid(projector, *seen, ray.direction, rng, [&](const ReturnedLight& light) {
      radiance += radiance_dn(rig.sensor, light.reflected) * intensity(light.direction);
    });
  return radiance / kWalks;
}

}  // namespace

Image<float> render_ir(const PointLight& projector, const Rig& rig, const Pattern& pattern, int samples_across,
                       TurbidModel turbid, std::uint64_t seed) {
  const SensorModel& sensor = rig.sensor;
  const double px_per_ir_px = 1.0 / sensor.ir_scale();
  const Eigen::Vector3d camera = rig.camera_in_world();
  Image<float> image(sensor.ir_width, sensor.ir_height);
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto pixel = static_cast<std::uint64_t>(y) * image.width() + x;
        std::uint64_t samples = 0;
        const auto sample = [&](double dx, double dy) {
          const double x_px = (x + dx) * px_per_ir_px, y_px = (y - sensor.ir_first_row() + dy) * px_per_ir_px;
          return sample_radiance(projector, rig, pattern, {camera, rig.direction_in_world(x_px, y_px)}, turbid,
                                 Rng(seed, kWalkStream, pixel, samples++));
        };
        image(x, y) = static_cast<float>(pixel_mean(samples_across, sample));
      }
  });
  return image;
}

std::vector<float> speckle_gains(const NoiseModel& noise, const Pattern& pattern, std::uint64_t seed) {
  std::vector<float> gains;
  if (noise.speckle_shape <= 0.0) return gains;
  gains.resize(static_cast<std::size_t>(pattern.columns()) * pattern.rows());
  for (std::size_t dot = 0; dot < gains.size(); ++dot)
    gains[dot] =
        static_cast<float>(Rng(seed, kSpeckleStream, dot).gamma(noise.speckle_shape, 1.0 / noise.speckle_shape));
  return gains;
}

Image<float> expose(const Image<float>& radiance, const NoiseModel& noise, std::uint64_t seed, std::uint64_t frame) {
  Image<float> image(radiance.width(), radiance.height());
  const double full_scale = noise.bits > 0 ? std::exp2(noise.bits) - 1.0 : 0.0;
  const bool random = noise.electrons_per_dn > 0.0 || noise.read_dn > 0.0;
  parallel_ranges(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width(); ++x) {
        double value = radiance(x, y);
        if (random) {
          Rng rng(seed, kDetectorStream, frame, static_cast<std::uint64_t>(y) * image.width() + x);
          const double shot_variance = noise.electrons_per_dn > 0.0 ? value / noise.electrons_per_dn : 0.0;
          value += std::sqrt(shot_variance + noise.read_dn * noise.read_dn) * rng.normal();
        }
        if (noise.bits > 0) value = std::clamp(std::round(value), 0.0, full_scale);
        image(x, y) = static_cast<float>(value);
      }
  });
  return image;
}

}  // namespace fathom
