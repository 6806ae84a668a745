#include "diagnosis/predict/surrogate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/estimate.h"
#include "core/units.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/predict/turbid_dots.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace {

constexpr double kFarthestDesk = 2.0;  // [m] beyond, a desk is none

Pose believed_pose(const LaboratoryRig& rig) {
  return camera_pose({0.0, 0.0, rig.height_m}, rig.pitch_rad, 0.0, rig.roll_rad, rig.baseline_m);
}

/// Samples lie where they lie, but a frame's noise spreads its points over many steps and millimetres. Of the law's
/// depths, cut to whole millimetres, the cut is even over one, which is k steps: the mean cosine of that is sinc k.
/// `phase`: by how many steps codes stand beside those that the comb is measured on.
void set_combs(std::span<const SensedPoint> desk, const SensorModel& sensor, double phase, FrameEstimates& estimates) {
  estimates.step_comb = 0.0;
  estimates.coarse_combs.fill(0.0);
  estimates.millimetre_comb = sensor.law.quantized ? 1.0 : 0.0;
  if (!sensor.law.quantized) return;
  const Calibration believed = sensor.calibration();
  const auto strength = [&](int codes) {
    double sum = 0.0, weight = 0.0;
    for (const SensedPoint& sensed : desk) {
      const double steps =
          8.0 / codes * believed.focal_px * believed.baseline * kMetresPerMm / (sensed.point.z() * sensed.point.z());
      sum += sensed.weight * std::sin(std::numbers::pi * steps) / (std::numbers::pi * steps);
      weight += sensed.weight;
    }
    return weight > 0.0 ? sum / weight : 0.0;
  };
  estimates.step_comb = strength(1) * std::cos(2.0 * std::numbers::pi * phase);
  for (std::size_t i = 0; i < kCoarseCombs.size(); ++i)
    if (sensor.law.codes_per_step % kCoarseCombs[i] == 0) estimates.coarse_combs[i] = strength(kCoarseCombs[i]);
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

/// What a device reads at some pixels, where `look(ray)` is what is seen.
template <class Look>
std::vector<SensedPoint> points_at(const DeviceReader& read, const std::vector<Eigen::Vector2d>& pixels, double weight,
                                   const Look& look) {
  std::vector<SensedPoint> points;
  points.reserve(pixels.size());
  for (const Eigen::Vector2d& pixel : pixels)
    if (const auto point = read(pixel, weight, look)) points.push_back(*point);
  return points;
}

std::vector<SensedPoint> desk_points(const SurrogateView& view, const SampledPixels& pixels) {
  const Eigen::Vector3d camera = view.reader.rig().camera_in_world(),
                        projector = view.reader.rig().projector_in_world();
  return points_at(view.reader, pixels.desk, pixels.desk_weight, [&](const Ray& sight) -> std::optional<SeenLight> {
    if (sight.direction.z() >= 0.0) return std::nullopt;
    const Eigen::Vector3d point = camera - camera.z() / sight.direction.z() * sight.direction;
    if (point.head<2>().norm() > kFarthestDesk) return std::nullopt;
    if (view.cup && (is_hidden(view.cup->body, point, camera) || is_hidden(view.cup->body, point, projector)))
      return std::nullopt;
    const Eigen::Vector3d way = point - projector;
    const double distance = way.norm();
    return SeenLight{way / distance, view.desk_albedo * -way.z() / (distance * distance * distance)};
  });
}

bool is_clear(const CupOptics& cup) { return cup.layers.empty() || !cup.layers.back().opaque; }

/// The same cup at moments that stand for all: nobody knows where waves are in a shot, nor whence they come. Three
/// phases leave of the first two orders of their slope its mean square alone; two directions across each other, 22.5°
/// off the baseline's, are as the mean over all in what goes by twice or four times their angle with it.
std::vector<CupOptics> moments_of(const CupOptics& cup) {
  const LiquidTop* surface = cup.surface();
  if (!surface || !surface->has_waves()) return {cup};
  std::vector<CupOptics> moments;
  for (const double azimuth : {0.125 * std::numbers::pi, 0.625 * std::numbers::pi})
    for (const double phase : {0.0, 2.0 / 3.0 * std::numbers::pi, 4.0 / 3.0 * std::numbers::pi}) {
      moments.push_back(cup);
      for (LiquidLayer& layer : moments.back().layers) layer.top.turn_waves(azimuth, phase);
    }
  return moments;
}

/// What light says of a sight in the mean over some moments, those in which there is any.
std::optional<SeenLight> mean_light(const SurrogateView& view, std::span<const CupOptics> moments, const Ray& sight) {
  const Rig& rig = view.reader.rig();
  const std::vector<LiquidLayer>& layers = view.cup->layers;
  const bool reduced = view.bisector > 0.0 && layers.size() == 1 && !layers.front().opaque;
  SeenLight sum{Eigen::Vector3d::Zero(), 0.0};
  int seen = 0;
  for (const CupOptics& cup : moments) {
    const auto lit = look_into(cup, sight, rig.projector_in_world());
    if (!lit) continue;
    sum.projector_direction +=
        reduced ? by_closed_form(rig, layers.front(), sight, *lit, view.bisector) : lit->projector_direction;
    sum.reflected += lit->reflected;
    ++seen;
  }
  if (seen == 0) return std::nullopt;
  if (seen == 1) return sum;
  return SeenLight{sum.projector_direction.normalized(), sum.reflected / seen};
}

std::vector<SensedPoint> points_through(const SurrogateView& view, std::span<const CupOptics> moments,
                                        const SampledPixels& pixels, double weight) {
  return points_at(view.reader, pixels.cup, weight, [&](const Ray& sight) { return mean_light(view, moments, sight); });
}

/// Through waves each point is the mean over all moments: a matcher's window spans most of a wave, so that no height
/// that it reads is as far off as the steepest part has it, beyond what counts as the cup's. On an opaque liquid each
/// moment has its points: none is far off, and their spread is the waves'.
std::vector<SensedPoint> inside_points(const SurrogateView& view, const SampledPixels& pixels) {
  const std::vector<CupOptics> moments = moments_of(*view.cup);
  const std::size_t together = is_clear(*view.cup) ? moments.size() : 1;
  const double weight = pixels.cup_weight * static_cast<double>(together) / static_cast<double>(moments.size());
  std::vector<SensedPoint> points;
  for (std::size_t first = 0; first < moments.size(); first += together) {
    const auto seen = points_through(view, std::span(moments).subspan(first, together), pixels, weight);
    points.insert(points.end(), seen.begin(), seen.end());
  }
  return points;
}

std::vector<SensedPoint> wall_points(const SurrogateView& view, const SampledPixels& pixels) {
  const Eigen::Vector3d projector = view.reader.rig().projector_in_world();
  return points_at(view.reader, pixels.walls, pixels.wall_weight, [&](const Ray& sight) -> std::optional<SeenLight> {
    const auto lit = look_at_wall(view.cup->body, view.cup->surface(), sight, projector);
    if (!lit) return std::nullopt;
    return SeenLight{lit->projector_direction, lit->reflected};
  });
}

/// Where desks look alike, whether inside_points() are the same …
bool inside_looks_alike(const SurrogateView& a, const SurrogateView& b) {
  return a.bisector == b.bisector && a.cup == b.cup;
}

/// … and wall_points().
bool walls_look_alike(const SurrogateView& a, const SurrogateView& b) {
  const LiquidTop *one = a.cup ? a.cup->surface() : nullptr, *other = b.cup ? b.cup->surface() : nullptr;
  return one && other ? *one == *other : one == other;
}

struct BoxOfPixels {
  Eigen::AlignedBox2d box;  ///< [px] within the image
  double depth = 0.0;       ///< [m] of its farthest corner
};

/// What a square upright column of a cup's height, `half` [m] from its axis to each side, covers of the image.
BoxOfPixels pixels_about(const LaboratoryRig& rig, const Pose& camera_from_world, const Eigen::Vector2d& axis,
                         double half) {
  BoxOfPixels seen;
  for (const double height : {0.0, rig.cup.height()})
    for (const double x : {-half, half})
      for (const double y : {-half, half}) {
        const Eigen::Vector3d p = camera_from_world * Eigen::Vector3d(axis.x() + x, axis.y() + y, height);
        if (p.z() <= 0.0) continue;
        seen.box.extend(Eigen::Vector2d(rig.focal_px * p.x() / p.z() + 0.5 * kImageWidth_px,
                                        rig.focal_px * p.y() / p.z() + 0.5 * kImageHeight_px));
        seen.depth = std::max(seen.depth, p.z());
      }
  seen.box = seen.box.intersection({Eigen::Vector2d::Zero(), Eigen::Vector2d(kImageWidth_px, kImageHeight_px)});
  return seen;
}

/// Those of the box that are a whole number of strides from `first`'s corner.
std::vector<Eigen::Vector2d> every(int stride, const Eigen::AlignedBox2d& first, const Eigen::AlignedBox2d& box) {
  const auto start = [stride](double from, double to) { return from + stride * std::ceil((to - from) / stride) + 0.5; };
  const double left = start(std::floor(first.min().x()), std::floor(box.min().x())),
               top = start(std::floor(first.min().y()), std::floor(box.min().y()));
  std::vector<Eigen::Vector2d> pixels;
  for (double y = top; y < box.max().y(); y += stride)
    for (double x = left; x < box.max().x(); x += stride) pixels.emplace_back(x, y);
  return pixels;
}

double half_of_inside(const LaboratoryRig& rig) { return 1.2 * interior_radius(rig.cup); }

constexpr int kStride = 2, kWallStride = 3;  ///< [px] some 300 in a cup 0.7 m away, as many on its walls

/// Pixels of a cup that stands at `axis`, of the same raster wherever near `place` that is.
void look_about(const LaboratoryRig& rig, const Eigen::Vector2d& place, const Eigen::Vector2d& axis,
                SampledPixels& pixels) {
  const Pose camera_from_world = believed_pose(rig).inverse();
  const auto box = [&](const Eigen::Vector2d& at, double half) {
    return pixels_about(rig, camera_from_world, at, half).box;
  };
  const double inside = half_of_inside(rig), walls = 1.1 * rig.cup.widest();
  pixels.cup = every(kStride, box(place, inside), box(axis, inside));
  pixels.walls = every(kWallStride, box(place, walls), box(axis, walls));
}

/// The pixels; of a cup that stands so far beside its place that they would miss some of its walls, those about it.
SampledPixels following(SampledPixels pixels, const LaboratoryRig& rig, const std::optional<CupOptics>& cup) {
  constexpr double kSpare = 0.003;  // [m] of 4 mm that are looked at around the walls
  const std::optional<Eigen::Vector2d> place = pixels.view.cup;
  if (place && cup && (cup->body.axis - *place).norm() > kSpare) look_about(rig, *place, cup->body.axis, pixels);
  return pixels;
}

/// What clouds show of a desk: its part of the image, clear of the cup, as estimate_frame() has it.
std::vector<SensedPoint> seen_of(const std::vector<SensedPoint>& desk, const Plane& plane, const LaboratoryRig& rig,
                                 const FrameView& looked_at) {
  const Eigen::Isometry3d to_desk = desk_from_camera(plane);
  std::vector<SensedPoint> seen;
  for (const SensedPoint& sensed : desk) {
    const Eigen::Vector3d point = sensed.point.cast<double>();
    if (looked_at.desk_px && !looked_at.desk_px->contains(pixel_of(rig, point))) continue;
    if (looked_at.cup &&
        ((to_desk * point).head<2>() - axis_from_camera(rig, *looked_at.cup)).norm() < clear_of_cup(rig))
      continue;
    seen.push_back(sensed);
  }
  return seen;
}

/// Of the frame's points, or what was made of them.
std::optional<FrameEstimates> estimates_of(std::span<const SensedPoint> points, const SurrogateView& view,
                                           const std::vector<SensedPoint>& desk, const LaboratoryRig& rig,
                                           const FrameView& looked_at) {
  auto estimates = estimate_frame(points, rig, looked_at);
  if (estimates)
    set_combs(seen_of(desk, estimates->desk, rig, looked_at), view.reader.rig().sensor,
              view.step_phase - DepthLaw().step_phase, *estimates);
  return estimates;
}

std::vector<SensedPoint> all_points(const SurrogateFrame& frame) {
  std::vector<SensedPoint> points = frame.desk;
  points.insert(points.end(), frame.inside.begin(), frame.inside.end());
  points.insert(points.end(), frame.walls.begin(), frame.walls.end());
  return points;
}

/// Of every part of the cup the share that lies in a shadow, or within a matcher's reach of one. `parts_of` gives the
/// shares that a point has in the parts.
template <std::size_t count, class PartsOf>
std::array<double, count> parts_near_shadows(const SurrogateFrame& frame, const SampledPixels& pixels,
                                             const PartsOf& parts_of) {
  constexpr double kReach = 0.006;  // [m] half a window of 9 pixels, 0.75 m away
  std::array<double, count> all{}, dark{};
  const std::optional<CupOptics>& cup = frame.view.cup;
  if (!cup || !pixels.view.cup || !frame.estimates) return all;
  const double height = frame.estimates->interior.mean;  // where pixels seem to look
  const Rig& sensor = frame.view.reader.rig();
  const Eigen::Vector3d camera = sensor.camera_in_world(), projector = sensor.projector_in_world();
  for (const Eigen::Vector2d& pixel : pixels.cup) {
    const Ray sight{camera, sensor.direction_in_world(pixel.x(), pixel.y())};
    if (sight.direction.z() >= 0.0) continue;
    const Eigen::Vector3d point = camera + (height - camera.z()) / sight.direction.z() * sight.direction;
    const Eigen::Vector2d from_axis = point.head<2>() - *pixels.view.cup;
    const std::array<double, count> own = parts_of(from_axis);
    for (std::size_t i = 0; i < count; ++i) all[i] += own[i];
    if (look_into(*cup, sight, projector)) continue;
    std::array<double, count> reached = own;
    for (int eighth = 0; eighth < 8; ++eighth) {
      const std::array<double, count> there =
          parts_of(from_axis + kReach * direction_of(0.25 * std::numbers::pi * eighth));
      for (std::size_t i = 0; i < count; ++i) reached[i] = std::max(reached[i], there[i]);
    }
    for (std::size_t i = 0; i < count; ++i) dark[i] += reached[i];
  }
  for (std::size_t i = 0; i < count; ++i) dark[i] = all[i] > 0.0 ? dark[i] / all[i] : 1.0;
  return dark;
}

}  // namespace

SurrogateView surrogate_view(const Setup& setup) {
  return {DeviceReader(setup), setup.scene.desk ? setup.scene.desk->albedo : 0.0, setup.processing.bisector,
          setup.rig.sensor.law.step_phase, cup_optics(setup)};
}

double log_contrast_of_dots(const Setup& setup) {
  const std::optional<CupOptics> cup = cup_optics(setup);
  if (!cup || cup->layers.empty() || !cup->layers.back().opaque) return 0.0;
  const LiquidLayer& layer = cup->layers.back();
  const Eigen::Vector3d surface(cup->body.axis.x(), cup->body.axis.y(), layer.at);
  const double distance = (surface - setup.rig.projector_in_world()).norm();
  return std::log(dot_contrast(layer.core_rad * distance / layer.transport_length));
}

bool desk_looks_alike(const SurrogateView& a, const SurrogateView& b) {
  return a.reader == b.reader && a.desk_albedo == b.desk_albedo && a.cup.has_value() == b.cup.has_value() &&
         (!a.cup || a.cup->body == b.cup->body);
}

SampledPixels sample_pixels(const LaboratoryRig& rig, const FrameView& written) {
  SampledPixels pixels;
  pixels.view = written;
  for (int row = 0; row < kDeskRows; ++row)
    for (int column = 0; column < kDeskColumns; ++column)
      pixels.desk.emplace_back((column + 0.5) * kImageWidth_px / kDeskColumns,
                               (row + 0.5) * kImageHeight_px / kDeskRows);
  pixels.desk_weight = kImageWidth_px * kImageHeight_px / (kDeskColumns * kDeskRows);
  if (!written.cup) return pixels;

  look_about(rig, *written.cup, *written.cup, pixels);
  pixels.view.soft_m =
      kStride * pixels_about(rig, believed_pose(rig).inverse(), *written.cup, half_of_inside(rig)).depth / rig.focal_px;
  pixels.cup_weight = kStride * kStride;
  pixels.wall_weight = kWallStride * kWallStride;
  return pixels;
}

std::array<double, 5> shares_near_shadows(const SurrogateFrame& frame, const LaboratoryRig& rig,
                                          const SampledPixels& pixels) {
  const double radius = interior_radius(rig.cup);
  return parts_near_shadows<5>(
      frame, pixels, [radius](const Eigen::Vector2d& from_axis) { return shares_of_regions(from_axis, radius, 0.0); });
}

std::array<double, kCupCells> cells_near_shadows(const SurrogateFrame& frame, const LaboratoryRig& rig,
                                                 const SampledPixels& pixels) {
  const double radius = interior_radius(rig.cup);
  return parts_near_shadows<kCupCells>(frame, pixels, [radius](const Eigen::Vector2d& from_axis) {
    std::array<double, kCupCells> shares{};
    if (const int cell = cup_cell_of(from_axis, radius); cell >= 0) shares[cell] = 1.0;
    return shares;
  });
}

std::optional<UnderWaves> under_waves(const Setup& setup, const LaboratoryRig& rig, const SampledPixels& pixels) {
  const SurrogateView view = surrogate_view(setup);
  if (!view.cup || !is_clear(*view.cup)) return std::nullopt;
  const std::vector<CupOptics> moments = moments_of(*view.cup);
  if (moments.size() == 1) return std::nullopt;
  const std::vector<SensedPoint> desk = desk_points(view, pixels);
  std::array<Mean, 5> heights;
  std::array<RegionEstimate, 5> sums;
  for (const CupOptics& moment : moments) {
    std::vector<SensedPoint> points = points_through(view, std::span(&moment, 1), pixels, pixels.cup_weight);
    points.insert(points.end(), desk.begin(), desk.end());
    const auto estimates = estimate_frame(points, rig, pixels.view);
    if (!estimates) continue;
    for (std::size_t region = 0; region < heights.size(); ++region) {
      const RegionEstimate& height = estimates->height[region];
      if (height.weight >= kFewestInRegion) heights[region].add(height.mean);
      sums[region].strays += height.strays;
      sums[region].weight += height.weight;
    }
  }
  UnderWaves seen;
  for (std::size_t region = 0; region < sums.size(); ++region) seen.stray_share[region] = sums[region].stray_share();
  double variance = 0.0, regions = 0.0;
  for (const Mean& height : heights) {
    if (height.count() < moments.size()) continue;  // phases make a variance only together
    variance += static_cast<double>(height.count() - 1) * std::pow(height.estimate().standard_error, 2);
    ++regions;
  }
  if (regions > 0.0) seen.scatter_mm = mm_from_metres(std::sqrt(variance / regions));
  return seen;
}

SurrogateFrame surrogate_points(const Setup& setup, const LaboratoryRig& rig, const SampledPixels& fixed,
                                const SurrogateFrame* known) {
  SurrogateFrame frame{.view = surrogate_view(setup), .desk = {}, .inside = {}, .walls = {}, .estimates = {}};
  const SurrogateView& view = frame.view;
  const SampledPixels pixels = following(fixed, rig, view.cup);
  const bool same_desk = known && desk_looks_alike(view, known->view);
  const bool same_inside = same_desk && inside_looks_alike(view, known->view);
  const bool same_walls = same_desk && walls_look_alike(view, known->view);
  if (same_desk && same_inside && same_walls && view.step_phase == known->view.step_phase) {
    frame = *known;
    frame.is_known = true;
    return frame;
  }
  frame.desk = same_desk ? known->desk : desk_points(view, pixels);
  if (view.cup) {
    frame.inside = same_inside ? known->inside : inside_points(view, pixels);
    frame.walls = same_walls ? known->walls : wall_points(view, pixels);
  }
  return frame;
}

SurrogateFrame surrogate_frame(const Setup& setup, const LaboratoryRig& rig, const SampledPixels& pixels,
                               const SurrogateFrame* known) {
  SurrogateFrame frame = surrogate_points(setup, rig, pixels, known);
  if (!frame.is_known) frame.estimates = estimates_without({}, frame, rig, pixels);
  return frame;
}

std::optional<FrameEstimates> estimates_without(std::span<const Bias> biases, const SurrogateFrame& frame,
                                                const LaboratoryRig& rig, const SampledPixels& pixels) {
  std::vector<SensedPoint> points = all_points(frame);
  for (const Bias& bias : biases) take_off(bias, rig, points);
  return estimates_of(points, frame.view, frame.desk, rig, pixels.view);
}

}  // namespace fathom
