#include "diagnosis/predict/cup_optics.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "diagnosis/predict/turbid_dots.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/ray_differential.h"
#include "sim/optics/snell.h"
#include "sim/scene/cup.h"

namespace fathom {
namespace {

/// Where light's way down ends.
struct Way {
  Eigen::Vector3d end;
  Eigen::Vector3d direction;  ///< unit, at the end
  double n = 1.0;             ///< at the end
};

/// Where a ray that goes down meets a layer's top.
struct TopHit {
  Eigen::Vector3d point;
  SurfaceFrame frame;
};

/// What is left of light on its way down or up.
struct LightLeft {
  double transmittance = 1.0;

  void through(double absorption, double path) { transmittance *= fathom::transmittance(absorption, path); }
  void into(const Eigen::Vector3d& direction, const TopHit& top, double n_from, double n_to) {
    transmittance *= 1.0 - fresnel_reflectance(-direction.dot(top.frame.normal), n_from, n_to);
  }
};

/// The same, with the neighbours of its ray.
struct LightBeam {
  RayDifferential ray;
  LightLeft left{};

  void through(double absorption, double path) { left.through(absorption, path); }
  void into(const Eigen::Vector3d& direction, const TopHit& top, double n_from, double n_to) {
    left.into(direction, top, n_from, n_to);
    advance(ray, top.point, top.frame.normal);
    refract(ray, top.frame, n_from, n_to);
  }
};

double height_on(const std::vector<Eigen::Vector2d>& profile, double radius) {
  for (std::size_t i = 1; i < profile.size(); ++i)
    if (radius <= profile[i].x() && profile[i].x() > profile[i - 1].x())
      return std::lerp(profile[i - 1].y(), profile[i].y(),
                       std::max(radius - profile[i - 1].x(), 0.0) / (profile[i].x() - profile[i - 1].x()));
  return profile.back().y();
}

/// Radius of the inside at a height above its bottom's edge.
double radius_on(const std::vector<Eigen::Vector2d>& profile, double height) {
  for (std::size_t i = 1; i < profile.size(); ++i)
    if (height <= profile[i].y() && profile[i].y() > profile[i - 1].y())
      return std::lerp(profile[i - 1].x(), profile[i].x(),
                       std::max(height - profile[i - 1].y(), 0.0) / (profile[i].y() - profile[i - 1].y()));
  return profile.back().x();
}

Eigen::Vector3d at_height(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double height) {
  return from + (height - from.z()) / direction.z() * direction;
}

/// At a place of a surface z = height(x, y), seen from above.
SurfaceFrame frame_of(const LiquidTop::Height& top) {
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
  derivative.topLeftCorner<2, 2>() = -top.hessian;
  return surface_frame({-top.gradient.x(), -top.gradient.y(), 1.0}, derivative);
}

/// By Newton's method.
TopHit meet(const LiquidLayer& layer, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  constexpr int kSteps = 8;
  constexpr double kEnough = 1e-10;  // [m]
  Eigen::Vector3d point = at_height(from, direction, layer.at);
  if (layer.level) return {point, {Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()}};
  LiquidTop::Height top = layer.top.at(point.head<2>());
  for (int i = 0; i < kSteps && std::abs(top.z - point.z()) > kEnough; ++i) {
    const double slope = direction.z() - top.gradient.dot(direction.head<2>());
    point += (top.z - point.z()) / slope * direction;
    top = layer.top.at(point.head<2>());
  }
  return {point, frame_of(top)};
}

/// Through the tops of all clear layers; the end is on the last of them, or where it started. `light` is told of what
/// it meets.
template <class Light>
std::optional<Way> go_down(const CupOptics& cup, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                           Light& light) {
  Way way{from, direction};
  double absorption = 0.0;
  for (const LiquidLayer& layer : cup.layers) {
    const TopHit hit = meet(layer, way.end, way.direction);
    const Eigen::Vector2d from_axis = hit.point.head<2>() - cup.body.axis;
    const double wall = radius_on(cup.body.inner, hit.point.z());
    if (from_axis.squaredNorm() > wall * wall) return std::nullopt;
    light.through(absorption, (hit.point - way.end).norm());
    way.end = hit.point;
    if (layer.opaque) return way;
    const auto refracted = refract(way.direction, hit.frame.normal, way.n, layer.n);
    if (!refracted) return std::nullopt;
    light.into(way.direction, hit, way.n, layer.n);
    way.direction = *refracted;
    way.n = layer.n;
    absorption = layer.absorption;
  }
  return way;
}

double last_absorption(const CupOptics& cup) { return cup.layers.empty() ? 0.0 : cup.layers.back().absorption; }

bool passes_opening(const CupBody& cup, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  if (direction.z() >= 0.0) return false;
  return (at_height(from, direction, cup.rim).head<2>() - cup.axis).squaredNorm() < cup.rim_radius * cup.rim_radius;
}

/// The bottom's point that the way leads to.
std::optional<Eigen::Vector3d> meet_bottom(const CupBody& cup, const Way& way) {
  Eigen::Vector3d point = at_height(way.end, way.direction, cup.bottom.front().y());
  const bool flat = cup.bottom.front().y() == cup.bottom.back().y();
  for (int i = 0; i < (flat ? 0 : 6); ++i)
    point = at_height(way.end, way.direction, height_on(cup.bottom, (point.head<2>() - cup.axis).norm()));
  const double edge = cup.bottom.back().x();
  if ((point.head<2>() - cup.axis).squaredNorm() > edge * edge) return std::nullopt;
  return point;
}

/// The projector's light that lands on `target`, refracted on its way there: by Newton's method, with how the landing
/// changes with the direction. The determinant of that is the spreading of the light. Waves and menisci leave some
/// places without any.
std::optional<LitPoint> light_bottom(const CupOptics& cup, const Eigen::Vector3d& target,
                                     const Eigen::Vector3d& projector, const Way& seen, double to_surface) {
  constexpr int kSteps = 20;
  constexpr double kEnough = 1e-9;  // [m]
  Eigen::Vector3d direction = (target - projector).normalized();
  for (int i = 0; i < kSteps; ++i) {
    LightBeam down{ray_differential_from(projector, direction)};
    const auto way = go_down(cup, projector, direction, down);
    if (!way || way->direction.z() >= 0.0) return std::nullopt;
    const Eigen::Vector3d end = at_height(way->end, way->direction, target.z());
    advance(down.ray, end, Eigen::Vector3d::UnitZ());
    const Eigen::Matrix2d landing = down.ray.d_origin.topRows<2>();
    const Eigen::Vector2d off = (target - end).head<2>();
    if (off.squaredNorm() < kEnough * kEnough) {
      if (!passes_opening(cup.body, projector, direction)) return std::nullopt;
      down.through(last_absorption(cup), (end - way->end).norm());
      const double irradiance = 1.0 / std::abs(landing.determinant());
      const double to_camera = to_surface * transmittance(last_absorption(cup), (target - seen.end).norm());
      return LitPoint{target, direction,
                      cup.body.albedo * irradiance * down.left.transmittance * to_camera / (seen.n * seen.n)};
    }
    direction = (direction + perpendicular_to(direction) * (landing.inverse() * off)).normalized();
  }
  return std::nullopt;
}

/// An opaque liquid's light seems to be sent back from a depth (turbid_dots.h): it enters where the projector's ray to
/// there does. Its top is taken for level, so that sines are as in air over n.
std::optional<LitPoint> light_surface(const CupOptics& cup, const Way& seen, const Eigen::Vector3d& projector,
                                      double to_camera) {
  const LiquidLayer& layer = cup.layers.back();
  const Eigen::Vector3d there = seen.end - projector;
  const double distance = there.norm();  // nearly the camera's
  const double length = layer.transport_length * seen_depth(layer.core_rad * distance / layer.transport_length);
  const Eigen::Vector3d apart = seen.n * seen.direction - there / distance;
  const Eigen::Vector3d entry = seen.end + length / layer.n * Eigen::Vector3d(apart.x(), apart.y(), 0.0);
  const Eigen::Vector3d direction = (entry - projector).normalized();
  if (!passes_opening(cup.body, projector, direction)) return std::nullopt;
  return LitPoint{seen.end, direction, layer.albedo * -there.z() / (distance * distance * distance) * to_camera};
}

/// Two images of a dot correlate as wide as both together, each with the depth pixel that it is summed over [rad].
double correlation_core(const SensorModel& sensor) {
  const double dot_px = sensor.pattern.dot_sigma_ir_px / sensor.ir_scale();
  constexpr double kPixelVariance = 1.0 / 12.0;  // of an even square
  return std::sqrt(2.0 * (dot_px * dot_px + kPixelVariance)) / sensor.focal_px;
}

LiquidLayer layer_of(const Cup& cup, const SensorModel& sensor) {
  const CupShape& shape = std::get<CupShape>(cup.shape);
  const Filling& filling = *cup.filling;
  const Medium& medium = filling.medium;
  const double level = liquid_level(cup), n = medium.n(sensor.wavelength_nm);
  LiquidLayer layer{.top = LiquidTop(shape, level, filling.form),
                    .level = filling.form.level(),
                    .at = level,
                    .n = n,
                    .absorption = medium.absorption,
                    .opaque = medium.scatters(),
                    .transport_length = 0.0,
                    .core_rad = 0.0,
                    .albedo = 0.0};
  layer.top.move(cup.position);
  if (medium.scatters()) {
    layer.transport_length = 1.0 / medium.reduced_scattering();
    layer.core_rad = correlation_core(sensor);
    layer.albedo = diffuse_reflectance(medium, n);
  }
  return layer;
}

struct WallHit {
  Eigen::Vector3d point;
  Eigen::Vector3d outward;  ///< unit normal
};

/// Where a ray comes in through a wall from outside, or from inside meets it: the nearest such place of a profile of
/// (radius, height). Each piece is a cone, radius = radius at height 0 + lean · z, a quadratic in the ray's length.
std::optional<WallHit> meet_wall(const std::vector<Eigen::Vector2d>& profile, const Eigen::Vector2d& axis,
                                 const Ray& ray, bool from_inside) {
  const Eigen::Vector2d from = ray.origin.head<2>() - axis, along = ray.direction.head<2>();
  double nearest = INFINITY;
  WallHit hit;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d run = profile[i] - profile[i - 1];
    if (run.y() <= std::abs(run.x())) continue;  // a bottom, or a rim
    const double lean = run.x() / run.y();
    const double radius = profile[i].x() + lean * (ray.origin.z() - profile[i].y());
    const double widens = lean * ray.direction.z();
    const double a = along.squaredNorm() - widens * widens, b = from.dot(along) - radius * widens,
                 c = from.squaredNorm() - radius * radius;
    const double root = b * b - a * c;
    if (a <= 0.0 || root < 0.0) continue;
    const double t = (-b + (from_inside ? 1.0 : -1.0) * std::sqrt(root)) / a;
    const Eigen::Vector3d point = ray.origin + t * ray.direction;
    if (t <= 0.0 || t >= nearest || point.z() < profile[i - 1].y() || point.z() > profile[i].y()) continue;
    const Eigen::Vector2d out = (point.head<2>() - axis).normalized();
    nearest = t;
    hit = {point, Eigen::Vector3d(out.x(), out.y(), -lean).normalized()};
  }
  return std::isfinite(nearest) ? std::optional(hit) : std::nullopt;
}

double distance_at_rim(const CupBody& cup, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  return (at_height(from, direction, cup.rim).head<2>() - cup.axis).norm();
}

bool is_dry(const LiquidTop* surface, const Eigen::Vector3d& point) {
  return !surface || point.z() > surface->at(point.head<2>()).z;
}

}  // namespace

std::optional<CupOptics> cup_optics(const Setup& setup) {
  if (setup.scene.cups.empty()) return std::nullopt;
  const Cup& cup = setup.scene.cups.front();
  const auto* shape = std::get_if<CupShape>(&cup.shape);
  if (!shape || shape->material)
    throw Error(cup_name(cup), "must be an opaque cup of revolution; light that passes walls is not predicted");
  CupBody body{
      .axis = cup.position,
      .rim = shape->height(),
      .rim_radius = shape->inner.back().x(),
      .albedo = shape->albedo,
      .bottom = {shape->inner.begin(), shape->inner.begin() + static_cast<std::ptrdiff_t>(shape->bottom_points())},
      .inner = shape->inner,
      .outer = shape->outer};
  CupOptics optics{std::move(body), {}};
  for (const Cup& layered : setup.scene.cups)
    if (layered.filling) optics.layers.push_back(layer_of(layered, setup.rig.sensor));
  return optics;
}

std::optional<LitPoint> look_into(const CupOptics& cup, const Ray& camera_ray, const Eigen::Vector3d& projector) {
  if (!passes_opening(cup.body, camera_ray.origin, camera_ray.direction)) return std::nullopt;
  LightLeft up;
  const auto seen = go_down(cup, camera_ray.origin, camera_ray.direction, up);
  if (!seen) return std::nullopt;
  if (!cup.layers.empty() && cup.layers.back().opaque) return light_surface(cup, *seen, projector, up.transmittance);
  const auto target = meet_bottom(cup.body, *seen);
  if (!target) return std::nullopt;
  return light_bottom(cup, *target, projector, *seen, up.transmittance);
}

std::optional<LitPoint> look_at_wall(const CupBody& cup, const LiquidTop* surface, const Ray& camera_ray,
                                     const Eigen::Vector3d& projector) {
  if (camera_ray.direction.z() >= 0.0) return std::nullopt;
  const double at_rim = distance_at_rim(cup, camera_ray.origin, camera_ray.direction);
  const bool is_inside = at_rim < cup.rim_radius;
  if (!is_inside && at_rim < cup.outer.back().x()) return std::nullopt;  // the rim
  const auto hit = meet_wall(is_inside ? cup.inner : cup.outer, cup.axis, camera_ray, is_inside);
  if (!hit || (is_inside && !is_dry(surface, hit->point))) return std::nullopt;
  const Eigen::Vector3d way = hit->point - projector;
  const double distance = way.norm();
  const Eigen::Vector3d direction = way / distance;
  const double cosine = direction.dot(is_inside ? hit->outward : -hit->outward);
  if (cosine <= 0.0) return std::nullopt;
  if (is_inside && distance_at_rim(cup, projector, direction) >= cup.rim_radius) return std::nullopt;
  return LitPoint{hit->point, direction, cup.albedo * cosine / (distance * distance)};
}

bool is_hidden(const CupBody& cup, const Eigen::Vector3d& on_desk, const Eigen::Vector3d& source) {
  // From the desk's point on the way runs along a line, seen from above; the outside is a stack of cones. Of each: how
  // far within it the way comes, a quadratic in the height.
  const Eigen::Vector2d start = on_desk.head<2>() - cup.axis;
  const Eigen::Vector2d per_height = (source - on_desk).head<2>() / source.z();
  for (std::size_t i = 1; i < cup.outer.size(); ++i) {
    const double low = cup.outer[i - 1].y(), span = cup.outer[i].y() - low;
    if (span <= 0.0) continue;
    const double lean = (cup.outer[i].x() - cup.outer[i - 1].x()) / span;
    const Eigen::Vector2d from = start + low * per_height;
    const auto outside = [&](double up) {
      const double radius = cup.outer[i - 1].x() + lean * up;
      return (from + up * per_height).squaredNorm() - radius * radius;
    };
    const double bend = per_height.squaredNorm() - lean * lean;
    const double lowest = bend > 0.0 ? (cup.outer[i - 1].x() * lean - from.dot(per_height)) / bend : 0.0;
    if (std::min({outside(std::clamp(lowest, 0.0, span)), outside(0.0), outside(span)}) < 0.0) return true;
  }
  return false;
}

}  // namespace fathom
