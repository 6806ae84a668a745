// What a device makes of the light that comes to a pixel, in the mean of many frames.
#pragma once

#include <cmath>
#include <optional>

#include "diagnosis/measurement/frame_estimates.h"
#include "sim/render/radiance.h"
#include "sim/render/truth.h"
#include "sim/scene/setup.h"
#include "sim/sensor/depth.h"

namespace fathom {

/// Light that comes to a pixel.
struct SeenLight {
  Eigen::Vector3d projector_direction;  ///< unit, in which it left the projector
  double reflected;                     ///< as radiance_dn() takes it
};

/// Readers are equal where they read the same light alike.
class DeviceReader {
 public:
  explicit DeviceReader(const Setup& setup);

  /// `look(ray)` is what is seen there, if anything: std::optional<SeenLight>.
  template <class Look>
  std::optional<SensedPoint> operator()(const Eigen::Vector2d& pixel, double weight, const Look& look) const {
    const Ray ray = sight(pixel);
    const std::optional<SeenLight> seen = look(ray);
    if (!seen) return std::nullopt;
    const auto own = disparity(pixel, ray, *seen);
    if (!own) return std::nullopt;
    return point_read(pixel, window_px_ > 1.0 ? window_mean(pixel, *own, look) : *own, seen->reflected, weight);
  }

  /// What is read from, without noise.
  const Rig& rig() const { return rig_; }

  bool operator==(const DeviceReader&) const = default;

 private:
  Ray sight(const Eigen::Vector2d& pixel) const {
    return {rig_.camera_in_world(), rig_.direction_in_world(pixel.x(), pixel.y())};
  }

  std::optional<double> disparity(const Eigen::Vector2d& pixel, const Ray& ray, const SeenLight& seen) const {
    const auto depth = triangulated_depth(rig_, ray.direction, seen.projector_direction);
    if (!depth) return std::nullopt;
    return seen_disparity(rig_.sensor, pixel, *depth);
  }

  /// By nine places for the square, each a third of its width apart: exact for planes, and for curvature to 1/9.
  template <class Look>
  double window_mean(const Eigen::Vector2d& pixel, double own, const Look& look) const {
    double sum = 0.0;
    int known = 0;
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column) {
        const Eigen::Vector2d there = pixel + window_px_ / 3.0 * Eigen::Vector2d(column, row);
        const Ray ray = sight(there);
        const std::optional<SeenLight> seen = look(ray);
        const std::optional<double> other = seen ? disparity(there, ray, *seen) : std::nullopt;
        if (other && std::abs(*other - own) < kOneSurfacePx) sum += *other, ++known;
      }
    return sum / known;
  }

  std::optional<SensedPoint> point_read(const Eigen::Vector2d& pixel, double disparity_px, double reflected,
                                        double weight) const;

  Rig rig_;
  UnitError error_;
  double window_px_;
  double aside_m_;  ///< where the camera stands in whose view points are given
};

}  // namespace fathom
