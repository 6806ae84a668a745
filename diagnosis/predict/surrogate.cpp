#include "diagnosis/predict/surrogate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/predict/cup_optics.h"
#include "diagnosis/predict/cup_walls.h"
#include "sim/render/radiance.h"
#include "sim/render/truth.h"
#include "sim/sensor/depth.h"
#include "sim/sensor/reading.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace {

constexpr double kWidth = 640.0, kHeight = 480.0;  // [px]
constexpr double kFarthestDesk = 2.0;              // [m] beyond, a desk is none
constexpr double kHalfCode_px = 1.0 / 16.0;        // by which the middle of an even number of codes is no code

Pose believed_pose(const LaboratoryRig& rig) {
  return camera_pose({0.0, 0.0, rig.height_m}, rig.pitch_rad, 0.0, rig.roll_rad, rig.baseline_m);
}

/// Light that comes to a pixel.
struct Seen {
  Eigen::Vector3d projector_direction;  ///< unit, in which it left the projector
  double reflected;                     ///< as radiance_dn() takes it
};

/// What the device makes of it.
class Reader {
 public:
  explicit Reader(const Setup& setup)
      : rig_(setup.rig), calibration_(setup.rig.sensor.calibration()), window_px_(setup.processing.window_px) {
    UnitModel unit = rig_.sensor.unit;
    unit.wander_px = 0.0;
    error_ = unit_error(unit, 0);
  }

  /// `look(pixel)` is what is seen there, if anything.
  template <class Look>
  std::optional<SensedPoint> operator()(const Eigen::Vector2d& pixel, double weight, const Look& look) const {
    const std::optional<Seen> seen = look(sight(pixel));
    if (!seen) return std::nullopt;
    const auto own = disparity(pixel, *seen);
    if (!own) return std::nullopt;
    const double read = read_disparity(rig_.sensor, error_, window_px_ > 1.0 ? window_mean(pixel, *own, look) : *own);
    const double read_as = rig_.sensor.quantized && rig_.sensor.codes_per_step % 2 == 0 ? read - kHalfCode_px : read;
    if (read_as <= 0.0) return std::nullopt;
    constexpr double kCutOff = 0.5 * kMetresPerMm;  // depths are cut to whole millimetres
    const double z = depth_of_disparity(rig_.sensor, read_as) - (rig_.sensor.quantized ? kCutOff : 0.0);
    const Eigen::Vector2d across = z / calibration_.focal_px * (pixel - calibration_.principal_px);
    return SensedPoint{Eigen::Vector3d(across.x(), across.y(), z).cast<float>(),
                       static_cast<float>(radiance_dn(rig_.sensor, seen->reflected)), static_cast<float>(weight)};
  }

 private:
  Ray sight(const Eigen::Vector2d& pixel) const {
    return {rig_.camera_in_world(), rig_.direction_in_world(pixel.x(), pixel.y())};
  }

  std::optional<double> disparity(const Eigen::Vector2d& pixel, const Seen& seen) const {
    const auto depth = triangulated_depth(rig_, sight(pixel).direction, seen.projector_direction);
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
        const std::optional<Seen> seen = look(sight(there));
        const std::optional<double> other = seen ? disparity(there, *seen) : std::nullopt;
        if (other && std::abs(*other - own) < kOneSurfacePx) sum += *other, ++known;
      }
    return sum / known;
  }

  const Rig& rig_;
  Calibration calibration_;
  UnitError error_;
  double window_px_;
};

/// Samples lie where they lie, but a frame's noise spreads its points over many steps and millimetres. Of the law's
/// depths, cut to whole millimetres, the cut is even over one, which is k steps: the mean cosine of that is sinc k.
void set_combs(std::span<const SensedPoint> desk, const SensorModel& sensor, FrameEstimates& estimates) {
  estimates.step_comb.setZero();
  estimates.coarse_combs.fill(0.0);
  estimates.millimetre_comb = sensor.quantized ? 1.0 : 0.0;
  if (!sensor.quantized) return;
  const Calibration believed = sensor.calibration();
  const auto strength = [&](int codes) {
    double sum = 0.0, weight = 0.0;
    for (const SensedPoint& sensed : desk) {
      const double steps =
          8.0 / codes * believed.focal_px * believed.baseline * kMetresPerMm / (sensed.point.z() * sensed.point.z());
      sum += sensed.weight * std::sin(std::numbers::pi * steps) / (std::numbers::pi * steps);
      weight += sensed.weight;
    }
    return sum / weight;
  };
  estimates.step_comb.x() = strength(1);
  for (std::size_t i = 0; i < kCoarseCombs.size(); ++i)
    if (sensor.codes_per_step % kCoarseCombs[i] == 0) estimates.coarse_combs[i] = strength(kCoarseCombs[i]);
}

/// In which direction light would have left the projector, if the raised bottom lay, by this share, where the paper's
/// Eq. 7 has it for the bottom's point: that of the place at that height on the line of sight.
Eigen::Vector3d by_closed_form(const Rig& rig, const LiquidLayer& liquid, const Ray& sight, const LitPoint& lit,
                               double share) {
  const auto depth = triangulated_depth(rig, sight.direction, lit.projector_direction);
  if (!depth) return lit.projector_direction;
  const double exact =
      sight.origin.z() + *depth / rig.world_from_camera.linear().col(2).dot(sight.direction) * sight.direction.z();
  const Eigen::Vector3d from_sensor = lit.point - 0.5 * (rig.camera_in_world() + rig.projector_in_world());
  const double raised =
      lit.point.z() +
      theory::raised_height_at(
          liquid.at - lit.point.z(),
          {.h = -from_sensor.z(), .b = rig.sensor.baseline, .d = from_sensor.head<2>().norm(), .n = liquid.n});
  const double height = std::lerp(exact, raised, share);
  const Eigen::Vector3d place = sight.origin + (height - sight.origin.z()) / sight.direction.z() * sight.direction;
  return (place - rig.projector_in_world()).normalized();
}

struct BoxOfPixels {
  Eigen::AlignedBox2d box;  ///< [px] within the image
  double depth = 0.0;       ///< [m] of its farthest corner
};

/// What a square upright column of a cup's height, `half` [m] from its axis to each side, covers of the image.
BoxOfPixels pixels_about(const LaboratoryRig& rig, const Pose& camera_from_world, const Eigen::Vector2d& axis,
                         double half) {
  BoxOfPixels seen;
  for (const double height : {0.0, rig.cup_height_m})
    for (const double x : {-half, half})
      for (const double y : {-half, half}) {
        const Eigen::Vector3d p = camera_from_world * Eigen::Vector3d(axis.x() + x, axis.y() + y, height);
        if (p.z() <= 0.0) continue;
        seen.box.extend(
            Eigen::Vector2d(rig.focal_px * p.x() / p.z() + 0.5 * kWidth, rig.focal_px * p.y() / p.z() + 0.5 * kHeight));
        seen.depth = std::max(seen.depth, p.z());
      }
  seen.box = seen.box.intersection({Eigen::Vector2d::Zero(), Eigen::Vector2d(kWidth, kHeight)});
  return seen;
}

std::vector<Eigen::Vector2d> every(int stride, const Eigen::AlignedBox2d& box) {
  std::vector<Eigen::Vector2d> pixels;
  for (double y = std::floor(box.min().y()) + 0.5; y < box.max().y(); y += stride)
    for (double x = std::floor(box.min().x()) + 0.5; x < box.max().x(); x += stride) pixels.emplace_back(x, y);
  return pixels;
}

}  // namespace

SampledPixels sample_pixels(const LaboratoryRig& rig, const std::optional<Eigen::Vector2d>& cup) {
  constexpr int kDeskColumns = 24, kDeskRows = 18;
  SampledPixels pixels;
  for (int row = 0; row < kDeskRows; ++row)
    for (int column = 0; column < kDeskColumns; ++column)
      pixels.desk.emplace_back((column + 0.5) * kWidth / kDeskColumns, (row + 0.5) * kHeight / kDeskRows);
  pixels.desk_weight = kWidth * kHeight / (kDeskColumns * kDeskRows);
  if (!cup) return pixels;

  const Pose camera_from_world = believed_pose(rig).inverse();
  constexpr int kStride = 2, kWallStride = 3;  // some 300 in a cup 0.7 m away, as many on its walls
  const BoxOfPixels inside = pixels_about(rig, camera_from_world, *cup, 1.2 * (rig.inner_radius_m - kInteriorMargin));
  pixels.cup = every(kStride, inside.box);
  pixels.cup_weight = kStride * kStride;
  pixels.soft_m = kStride * inside.depth / rig.focal_px;
  pixels.walls = every(kWallStride, pixels_about(rig, camera_from_world, *cup, 1.1 * rig.outer_radius_m).box);
  pixels.wall_weight = kWallStride * kWallStride;
  return pixels;
}

std::array<double, 5> shares_near_shadows(const Setup& setup, const LaboratoryRig& rig, const Eigen::Vector2d& place,
                                          const SampledPixels& pixels) {
  constexpr double kReach = 0.006;  // [m] half a window of 9 pixels, 0.75 m away
  std::array<double, 5> all{}, dark{};
  const std::optional<CupOptics> cup = cup_optics(setup);
  const std::optional<FrameEstimates> frame = surrogate_frame(setup, rig, place, pixels);
  if (!cup || !frame) return all;
  const double height = frame->interior.mean;  // where pixels seem to look
  const double radius = rig.inner_radius_m - kInteriorMargin;
  const Eigen::Vector3d camera = setup.rig.camera_in_world(), projector = setup.rig.projector_in_world();
  for (const Eigen::Vector2d& pixel : pixels.cup) {
    const Ray sight{camera, setup.rig.direction_in_world(pixel.x(), pixel.y())};
    if (sight.direction.z() >= 0.0) continue;
    const Eigen::Vector3d point = camera + (height - camera.z()) / sight.direction.z() * sight.direction;
    const Eigen::Vector2d from_axis = point.head<2>() - place;
    const std::array<double, 5> own = shares_of_regions(from_axis, radius, 0.0);
    for (std::size_t i = 0; i < own.size(); ++i) all[i] += own[i];
    if (look_into(*cup, sight, projector)) continue;
    std::array<double, 5> reached = own;
    for (int eighth = 0; eighth < 8; ++eighth) {
      const Eigen::Vector2d beside = from_axis + kReach * direction_of(0.25 * std::numbers::pi * eighth);
      const std::array<double, 5> there = shares_of_regions(beside, radius, 0.0);
      for (std::size_t i = 0; i < own.size(); ++i) reached[i] = std::max(reached[i], there[i]);
    }
    for (std::size_t i = 0; i < own.size(); ++i) dark[i] += reached[i];
  }
  for (std::size_t i = 0; i < all.size(); ++i) dark[i] = all[i] > 0.0 ? dark[i] / all[i] : 1.0;
  return dark;
}

std::optional<FrameEstimates> surrogate_frame(const Setup& setup, const LaboratoryRig& rig,
                                              const std::optional<Eigen::Vector2d>& place,
                                              const SampledPixels& pixels) {
  const std::optional<CupOptics> cup = cup_optics(setup);
  const Eigen::Vector3d camera = setup.rig.camera_in_world(), projector = setup.rig.projector_in_world();
  const double desk_albedo = setup.scene.desk ? setup.scene.desk->albedo : 0.0;
  const Reader read(setup);
  std::vector<SensedPoint> points;
  points.reserve(pixels.desk.size() + pixels.cup.size() + pixels.walls.size());
  const auto add = [&](const std::optional<SensedPoint>& point) {
    if (point) points.push_back(*point);
  };
  const auto look_at_desk = [&](const Ray& sight) -> std::optional<Seen> {
    if (sight.direction.z() >= 0.0) return std::nullopt;
    const Eigen::Vector3d point = camera - camera.z() / sight.direction.z() * sight.direction;
    if (point.head<2>().norm() > kFarthestDesk) return std::nullopt;
    if (cup && (is_hidden(*cup, point, camera) || is_hidden(*cup, point, projector))) return std::nullopt;
    const Eigen::Vector3d way = point - projector;
    const double distance = way.norm();
    return Seen{way / distance, desk_albedo * -way.z() / (distance * distance * distance)};
  };
  const auto look_into_cup = [&](const Ray& sight) -> std::optional<Seen> {
    const auto lit = look_into(*cup, sight, projector);
    if (!lit) return std::nullopt;
    const double share = setup.processing.bisector;
    const bool reduced = share > 0.0 && cup->layers.size() == 1 && !cup->layers.front().opaque;
    return Seen{reduced ? by_closed_form(setup.rig, cup->layers.front(), sight, *lit, share) : lit->projector_direction,
                lit->reflected};
  };
  const auto look_at_walls = [&](const Ray& sight) -> std::optional<Seen> {
    const auto lit = look_at_wall(*cup, sight, projector);
    if (!lit) return std::nullopt;
    return Seen{lit->projector_direction, lit->reflected};
  };
  for (const Eigen::Vector2d& pixel : pixels.desk) add(read(pixel, pixels.desk_weight, look_at_desk));
  const std::size_t on_desk = points.size();
  if (cup) {
    for (const Eigen::Vector2d& pixel : pixels.cup) add(read(pixel, pixels.cup_weight, look_into_cup));
    for (const Eigen::Vector2d& pixel : pixels.walls) add(read(pixel, pixels.wall_weight, look_at_walls));
  }
  std::optional<FrameEstimates> estimates = estimate_frame(points, rig, {place, pixels.soft_m});
  if (estimates) set_combs(std::span(points).first(on_desk), setup.rig.sensor, *estimates);
  return estimates;
}

}  // namespace fathom
