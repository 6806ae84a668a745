// What the generator itself can read from a placement: heights in regions of the cup, brightness, the desk's plane.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "blind/device_frames.h"
#include "blind/pack_plan.h"

namespace fathom::blind {

/// A plane z = height + slope · (x, y), in the world as the laboratory believes its sensor to stand.
struct DeskPlane {
  double height;
  Eigen::Vector2d slope;
  double above(const Eigen::Vector3d& point) const;  ///< distance of a point from it, up
};

/// By least squares. At least three points.
DeskPlane fit_plane(std::span<const Eigen::Vector3d> points);

/// A block's point in the world as the laboratory believes it, for a disparity without the device's steps.
Eigen::Vector3d believed_point(const Eyes& believed_eyes, const Eigen::Vector2d& pixel, double disparity_px);

/// One number, and what the device's noise makes it uncertain by, over all trials.
struct Reading {
  double value, sigma;
};

/// Regions of a placement's inside: the middle, four quarters of a ring; then the logarithms of the inside's and of the
/// inner wall's brightness, and the desk's height [m] and slopes. A sigma of 0: not seen.
inline constexpr int kRegions = 5, kBrightness = kRegions, kDesk = kRegions + 2, kReadings = kRegions + 5;
using Readings = std::array<Reading, kReadings>;

/// What light shows, before the device adds what it is off by: dots of the desk, and blocks of the cup's inside.
struct Look {
  std::vector<SeenDot> desk;
  Matched inside;  ///< empty without a cup
};
/// Noise-free, dots and grains keyed by `standing`.
Look look(const World& world, const Placement& placement, std::uint64_t standing);

/// What a device reads of it. Of `world` only the device's own errors count.
Readings readings_of(const Look& look, const World& world, const Placement& placement, int trials);

Readings observe(const World& world, const Placement& placement, int trials, std::uint64_t standing);

/// Mean, deviation and number of the points of a frame within the cup's nominal inside less 10 mm: what a laboratory
/// without a detector writes down. Nothing with fewer than 10 points.
struct MeanHeight {
  double mean, sd;
  int points;
};
std::optional<MeanHeight> mean_height(std::span<const CloudPoint> cloud, const Placement& placement);

}  // namespace fathom::blind
