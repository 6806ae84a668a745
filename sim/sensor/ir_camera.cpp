#include "sim/sensor/ir_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/parallel.h"
#include "core/rng.h"
#include "sim/render/connection.h"
#include "sim/render/light_walk.h"
#include "sim/render/nearby_ways.h"
#include "sim/render/photon_map.h"
#include "sim/render/radiance.h"
#include "sim/scene/geometry.h"
#include "sim/sensor/bloom.h"
#include "sim/sensor/blurred_pattern.h"
#include "sim/sensor/glints.h"
#include "sim/sensor/reference.h"
#include "sim/sensor/shared_walks.h"

namespace fathom {
namespace {

constexpr std::uint64_t kSpeckleStream = 0x737065636bULL;
constexpr std::uint64_t kDetectorStream = 0x6465746563ULL;
constexpr std::uint64_t kWalkStream = 0x77616c6bULL;
constexpr std::uint64_t kImageStream = 0x696d616765ULL;

/// Walks of its own of a camera ray that enters a scattering body; of other surfaces one.
constexpr int kWalksIntoBody = 4;

/// Transmittance below which mirror images are left to chance.
constexpr double kFaintImage = 0.12;

/// Rows for which walks are kept at a time, and what they share with others.
constexpr int kBandRows = 64;

/// Sums numbers that are even between 0 and 1 with steps that keep them even; without 1.
double wrapped(double sum) { return sum - std::floor(sum); }

/// The middles of the cells of a grid in the unit square, row by row.
std::vector<Eigen::Vector2d> sample_places(int across) {
  std::vector<Eigen::Vector2d> places;
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) places.emplace_back((column + 0.5) / across, (row + 0.5) / across);
  return places;
}

/// The camera's rays through places in the infrared image [px].
struct CameraRays {
  const Rig& rig;
  double px_per_ir_px = 1.0 / rig.sensor.ir_scale();
  double first_row = rig.sensor.ir_first_row();
  Eigen::Vector3d camera = rig.camera_in_world();

  Ray operator()(double x, double y) const {
    return {camera, rig.direction_in_world(x * px_per_ir_px, (y - first_row) * px_per_ir_px)};
  }
};

/// What a camera's samples look at, and what they look with.
struct Renderer {
  const PointLight& projector;
  const Rig& rig;
  const Pattern& pattern;
  const BlurredPattern& blurred;
  std::vector<Eigen::Vector2d> places;  ///< of a pixel's samples in it
  LightModel light;
  std::uint64_t seed;
  const SharedWalks* shared = nullptr;  ///< of all but direct light
  const NearbyWays* nearby = nullptr;   ///< where ways are searched for …
  const PhotonMap* photons = nullptr;   ///< … and some are not found
  CameraRays camera_ray{rig};
  std::optional<Defocus> defocus = rig.sensor.optics.defocuses() ? std::optional(Defocus(rig.sensor)) : std::nullopt;

  /// Of the dots as the camera sees them on a surface at `point`.
  double intensity(const Eigen::Vector3d& direction, const Eigen::Vector3d& point) const {
    if (!defocus) return intensity_towards(pattern, rig, direction);
    const double depth = rig.world_from_camera.linear().col(2).dot(point - rig.camera_in_world());
    return intensity_towards(pattern, rig, direction, defocus->blur_steps(depth));
  }

  int samples_per_pixel() const { return static_cast<int>(places.size()); }
  int samples_per_row() const { return samples_per_pixel() * rig.sensor.ir_width; }

  Ray ray_of(int y, int sample) const {
    const Eigen::Vector2d place = place_of(y, sample);
    return camera_ray(place.x(), place.y());
  }
  /// Where a sample of row y lies in the image; the samples of a pixel follow one another.
  Eigen::Vector2d place_of(int y, int sample) const {
    return places[sample % samples_per_pixel()] + Eigen::Vector2d(sample / samples_per_pixel(), y);
  }

  /// Of at most kPacket samples.
  struct Radiances {
    std::array<double, kPacket> projected{};  ///< [DN]
    std::array<double, kPacket> ambient{};    ///< over that of light on albedo 1
  };
  /// Of row y, from sample `first` on.
  Radiances radiances(int y, int first, int count) const {
    std::array<Ray, kPacket> rays;
    for (int i = 0; i < count; ++i) rays[i] = ray_of(y, first + i);
    Packet<SeenPoint> seen = see(projector.world(), std::span(rays.data(), count));
    Radiances result;
    for (int i = 0; i < count; ++i)
      if (const SeenPoint* at = seen.find(i)) result.ambient[i] = at->transmittance * at->albedo;
    std::array<double, kPacket>& sums = result.projected;
    if (light != LightModel::direct) {
      PixelDraws draws;
      for (int i = 0; i < count; ++i) {
        const SeenPoint* at = seen.find(i);
        if (i == 0 || (first + i) % samples_per_pixel() == 0) draws = draws_of(y, (first + i) / samples_per_pixel());
        if (light == LightModel::full || (at && at->entered))
          sums[i] += more_than_direct(y, first + i, draws, rays[i], at);
        if (at && at->entered) seen.reset(i);
      }
    }
    const auto add = [&](std::size_t i, const Illumination& from_projector) {
      if (light == LightModel::direct && from_projector.through_scattering) return;
      const SeenPoint& at = *seen.find(i);
      sums[i] += radiance_dn(rig.sensor, at, from_projector) * intensity(from_projector.direction, at.point);
    };
    for_each_illumination(projector, seen, add, [&](std::size_t i) {
      return starts(Ways::refracted, SharedWalks::straight, place_of(y, first + static_cast<int>(i)), *seen.find(i));
    });
    return result;
  }

  /// Light that surfaces reflect in part is some hundredths: one of a pixel's samples looks for it, whichever it is,
  /// and at least one at an image in such a surface. Evenly distributed numbers say which.
  struct PixelDraws {
    double image, ghost;
  };
  PixelDraws draws_of(int y, int x) const {
    Rng rng(seed, kImageStream, y, x);
    const double image = rng.uniform();
    return {image, rng.uniform()};
  }

  /// Radiance [DN] of a sample's light that for_each_illumination() leaves out. `at`: what it sees, if anything.
  double more_than_direct(int y, int number, const PixelDraws& draws, const Ray& ray, const SeenPoint* at) const {
    const bool is_full = light == LightModel::full;
    const int per_pixel = samples_per_pixel(), x = number / per_pixel, sample = number % per_pixel;
    Rng rng(seed, kWalkStream, y, number);
    const auto walked = [&](SharedWalks::Look look, const SeenPoint& seen) {
      const std::optional<double> of_all = shared->radiance(look, x, y, sample, per_pixel, seen);
      return of_all ? *of_all : walked_radiance(seen, rng);
    };
    const double share = 1.0 / per_pixel;
    double drawn = wrapped(draws.image + sample * share);
    const double ghost_share = projector.searches() ? share : 1.0;  // level mirrors need no search
    const bool sees_ghosts = is_full && wrapped(draws.ghost + sample * share) < ghost_share;
    const Eigen::Vector2d place = place_of(y, number);
    double sum = 0.0;
    if (at) {
      if (sees_ghosts) sum += ghost_radiance(SharedWalks::straight, place, *at, ghost_share, rng);
      sum += walked(SharedWalks::straight, *at);
    }
    if (at && !at->refracted && !at->entered) return sum;
    see_mirrored(projector.world(), ray, rng, [&](const SeenPoint& image) {
      const double chance = std::clamp(image.transmittance / kFaintImage, share, 1.0);
      drawn = wrapped(drawn + std::numbers::phi);
      if (drawn >= chance) return;
      sum += direct_radiance(SharedWalks::mirrored, place, image) / chance;
      if (sees_ghosts) sum += ghost_radiance(SharedWalks::mirrored, place, image, ghost_share, rng) / chance;
      if (is_full) sum += walked(SharedWalks::mirrored, image) / chance;
    });
    return sum;
  }

  /// As NearbyWays::starts().
  std::optional<std::vector<Start>> starts(Ways ways, SharedWalks::Look look, const Eigen::Vector2d& place,
                                           const SeenPoint& seen) const {
    return nearby ? nearby->starts(ways, look == SharedWalks::mirrored, place.x(), place.y(), seen) : std::nullopt;
  }

  double radiance_by(const Connection& way, const SeenPoint& seen) const {
    return radiance_dn(rig.sensor, seen, illumination_by(way, seen)) * intensity(way.direction, seen.point);
  }

  /// Radiance [DN] by light straight or refracted from the projector; of bodies that scatter the walks see all.
  double direct_radiance(SharedWalks::Look look, const Eigen::Vector2d& place, const SeenPoint& seen) const {
    double sum = 0.0;
    if (!seen.entered)
      projector.connect(
          alone(Receiver{seen.point, seen.around, &seen.normal}),
          [&](std::size_t, const Connection& way) { sum += radiance_by(way, seen); },
          [&](std::size_t) { return starts(Ways::refracted, look, place, seen); });
    return sum;
  }

  /// Radiance [DN] by reflections in liquids and glass; a share of a pixel's samples looks for it.
  double ghost_radiance(SharedWalks::Look look, const Eigen::Vector2d& place, const SeenPoint& seen, double share,
                        Rng& rng) const {
    double sum = photon_radiance(seen);
    if (seen.entered) return sum / share;
    const Receiver receiver{seen.point, seen.around, &seen.normal};
    std::vector<Connection> found;
    const auto known = starts(Ways::mirrored, look, place, seen);
    if (known && projector.follow(*known, receiver, found)) {
      for (const Connection& way : found) sum += radiance_by(way, seen);
    } else {
      projector.connect_mirrored(receiver, seen.transmittance / share, rng.uniform(),
                                 [&](const Connection& way) { sum += radiance_by(way, seen); });
    }
    return sum / share;
  }

  /// Radiance [DN] by what no search finds, with its dots as blurred as places are that photons count for. Glazes and
  /// bodies that scatter reflect it as diffuse surfaces of their albedo would.
  double photon_radiance(const SeenPoint& seen) const {
    double sum = 0.0;
    if (!photons) return sum;
    const double spread = PhotonMap::kRadius / (seen.point - projector.position()).norm();
    photons->near(seen.point, seen.normal, [&](const Eigen::Vector3d& direction, double irradiance) {
      const double reflected = seen.transmittance * seen.albedo * irradiance;
      sum += radiance_dn(rig.sensor, reflected) * intensity_around(blurred, rig, {direction, reflected, spread});
    });
    return sum;
  }

  /// Radiance [DN] by walks of its own.
  double walked_radiance(const SeenPoint& seen, Rng& rng) const {
    double sum = 0.0;
    const int walks = seen.entered && light == LightModel::full ? kWalksIntoBody : 1;
    for (int walk = 0; walk < walks; ++walk)
      walk_light(
          projector, seen, rng,
          [&](const ReturnedLight& returned) {
            sum += radiance_dn(rig.sensor, returned.reflected) * intensity_around(blurred, rig, returned);
          },
          nullptr, shared->near_start(seen));
    return sum / walks;
  }
};

/// Light goes back and forth between the faces of a solid. Waves and menisci in opaque cups reflect some of it twice,
/// too, but that is at most 0.04 % of what a square of 16 pixels sees.
bool has_clear_solid(const Geometry& geometry) {
  return std::ranges::any_of(geometry.bodies, [](const Body& body) { return !body.level; });
}

}  // namespace

IrLight render_ir(const PointLight& projector, const Rig& rig, const Pattern& pattern, int samples_across,
                  LightModel light, std::uint64_t seed) {
  const BlurredPattern blurred(pattern);
  std::optional<SharedWalks> shared;
  if (light != LightModel::direct)
    shared.emplace(projector, rig, blurred, light == LightModel::full ? kFineSharing : kCoarseSharing, seed, kBandRows);
  std::optional<NearbyWays> nearby;
  if (projector.searches())
    nearby.emplace(projector, CameraRays{rig}, rig.sensor.ir_width,
                   NearbyWays::Scope{light != LightModel::direct, light == LightModel::full});
  std::optional<PhotonMap> photons;
  if (light == LightModel::full && has_clear_solid(projector.world().geometry()))
    photons.emplace(projector.world(), projector.source(), seed);
  const Renderer renderer{projector,
                          rig,
                          pattern,
                          blurred,
                          sample_places(samples_across),
                          light,
                          seed,
                          shared ? &*shared : nullptr,
                          nearby ? &*nearby : nullptr,
                          photons ? &*photons : nullptr};
  const int width = rig.sensor.ir_width, height = rig.sensor.ir_height;
  const double ambient_dn = rig.sensor.noise.ambient_dn;
  IrLight image{Image<float>(width, height), ambient_dn > 0.0 ? Image<float>(width, height) : Image<float>()};
  const int per_pixel = renderer.samples_per_pixel(), per_row = renderer.samples_per_row();
  const auto render_rows = [&](int begin, int end) {
    std::vector<double> projected(width), ambient(width);
    for (int y = begin; y < end; ++y) {
      std::fill(projected.begin(), projected.end(), 0.0);
      std::fill(ambient.begin(), ambient.end(), 0.0);
      for (int first = 0; first < per_row; first += kPacket) {
        const int count = std::min<int>(kPacket, per_row - first);
        const Renderer::Radiances radiances = renderer.radiances(y, first, count);
        for (int i = 0; i < count; ++i) {
          projected[(first + i) / per_pixel] += radiances.projected[i];
          ambient[(first + i) / per_pixel] += radiances.ambient[i];
        }
      }
      for (int x = 0; x < width; ++x) {
        image.projected(x, y) = static_cast<float>(projected[x] / per_pixel);
        if (ambient_dn > 0.0) image.ambient(x, y) = static_cast<float>(ambient_dn * ambient[x] / per_pixel);
      }
    }
  };
  for (int top = 0; top < height; top += kBandRows) {
    const int rows = std::min(kBandRows, height - top);
    if (shared) shared->prepare(top, top + rows);
    if (nearby) nearby->prepare(top, top + rows);
    parallel_ranges(rows, [&](int begin, int end) { render_rows(top + begin, top + end); });
  }
  if (light == LightModel::full) add_glints(projector, rig, pattern, image.projected);
  return image;
}

std::vector<float> speckle_gains(const NoiseModel& noise, const Pattern& pattern, std::uint64_t seed) {
  std::vector<float> gains;
  if (noise.speckle_shape <= 0.0) return gains;
  gains.resize(static_cast<std::size_t>(pattern.columns()) * pattern.rows());
  for (std::size_t dot = 0; dot < gains.size(); ++dot)
    gains[dot] = static_cast<float>(
        Rng(seed, kSpeckleStream, dot).gamma(noise.speckle_shape, noise.speckle_mean / noise.speckle_shape));
  return gains;
}

Image<float> expose(const Image<float>& light, const NoiseModel& noise, std::uint64_t seed, std::uint64_t frame) {
  Image<float> image = light;
  for (float& value : image.pixels()) value *= static_cast<float>(noise.gain);
  const double full_scale = noise.bits > 0 ? std::exp2(noise.bits) - 1.0 : 0.0;
  if (noise.bits > 0) bloom(full_scale, noise.bloom_share, noise.bloom_ir_px, image);
  const bool random = noise.electrons_per_dn > 0.0 || noise.read_dn > 0.0;
  parallel_rows(image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      double value = image(x, y);
      if (random) {
        Rng rng(seed, kDetectorStream, frame, static_cast<std::uint64_t>(y) * image.width() + x);
        const double shot_variance = noise.electrons_per_dn > 0.0 ? value * noise.gain / noise.electrons_per_dn : 0.0;
        value += noise.offset_dn + std::sqrt(shot_variance + noise.read_dn * noise.read_dn) * rng.normal();
      }
      if (noise.bits > 0) value = std::clamp(std::round(value), 0.0, full_scale);
      image(x, y) = static_cast<float>(value);
    }
  });
  return image;
}

Image<float> at_depth_scale(const SensorModel& sensor, const Image<float>& ir) {
  const Image<float> half = columns_in_pairs(rows_in_pairs(ir));
  Image<float> middle(sensor.width, sensor.height);
  for (int y = 0; y < sensor.height; ++y)
    std::copy_n(half.row(y + sensor.ir_first_row() / 2), sensor.width, middle.row(y));
  return middle;
}

}  // namespace fathom
