#include "blind/follow.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "blind/fermat.h"
#include "blind/height_field.h"
#include "blind/turbid.h"

namespace fathom::blind {
namespace {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

constexpr double kDeskAlbedo = 0.55, kMilkAlbedo = 0.6, kFoamAlbedo = 0.5;
constexpr double kCoreMetres = 0.0012;  // of a dot that a matcher follows: a pixel at 0.7 m

struct Beam {
  Vector3 from, along;  ///< `along` has unit length
};

struct Landing {
  Vector3 point, normal;
  Lit lit;
  double albedo;
};

/// First crossing of an upright cylinder about the cup's axis by a beam, from outside or, for `inside`, the way out.
std::optional<double> cylinder(const Beam& beam, const Vector2& axis, double radius, bool inside) {
  const Vector2 o = beam.from.head<2>() - axis, d = beam.along.head<2>();
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius * radius;
  const double root = b * b - a * c;
  if (a < 1e-15 || root < 0.0) return std::nullopt;
  const double t = (-b + (inside ? 1.0 : -1.0) * std::sqrt(root)) / a;
  return t > 0.0 ? std::optional(t) : std::nullopt;
}

Vector3 at(const Beam& beam, double t) { return beam.from + t * beam.along; }

/// Where a beam meets z = f(x, y), by secants from where it meets the level z0.
template <class Field>
std::optional<Vector3> meet(const Beam& beam, double z0, const Field& field) {
  if (std::abs(beam.along.z()) < 1e-9) return std::nullopt;
  double t0 = (z0 - beam.from.z()) / beam.along.z();
  const auto above = [&](double t) {
    const Vector3 p = at(beam, t);
    return p.z() - field(Vector2(p.head<2>())).z;
  };
  double g0 = above(t0), t1 = t0 - g0 / beam.along.z();
  for (int i = 0; i < 20 && std::abs(t1 - t0) > 1e-12; ++i) {
    const double g1 = above(t1);
    if (g1 == g0) break;
    const double t2 = t1 - g1 * (t1 - t0) / (g1 - g0);
    t0 = t1, g0 = g1, t1 = t2;
  }
  if (!(t1 > 0.0)) return std::nullopt;
  return at(beam, t1);
}

/// Crests of a wave stay together along a surface: the part of n k along it is the same on both sides.
std::optional<Vector3> bent(const Vector3& along, const Vector3& normal_up, double n_from, double n_to) {
  const Vector3 tangential = n_from / n_to * (along - along.dot(normal_up) * normal_up);
  const double rest = 1.0 - tangential.squaredNorm();
  if (rest <= 0.0) return std::nullopt;
  return Vector3(tangential + std::copysign(std::sqrt(rest), along.dot(normal_up)) * normal_up);
}

Vector3 normal_of(const Slope& slope) { return Vector3(-slope.dx, -slope.dy, 1.0).normalized(); }

double fresnel(double cosine, double n) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / n, inside = std::sqrt(1.0 - sine * sine);
  const double s = (cosine - n * inside) / (cosine + n * inside), p = (inside - n * cosine) / (inside + n * cosine);
  return 0.5 * (s * s + p * p);
}

struct Cavity {
  const World& world;
  Vector2 axis;

  Slope top(const Vector2& p) const { return liquid_top(world, p - axis); }
  Slope floor(const Vector2& p) const { return cup_bottom(world.cup, p - axis); }
  Vector3 wall_normal(const Vector3& p) const {
    const Vector2 out = (p.head<2>() - axis).normalized();
    return {-out.x(), -out.y(), 0.0};
  }

  /// The bottom or the wall that a beam within the cup meets.
  std::optional<Landing> land(const Beam& beam) const {
    const auto wall = cylinder(beam, axis, world.cup.inner_radius, true);
    if (beam.along.z() < 0.0) {
      const auto hit = meet(beam, world.cup.bottom, [&](const Vector2& p) { return floor(p); });
      if (hit && (hit->head<2>() - axis).norm() <= world.cup.inner_radius)
        return Landing{*hit, normal_of(floor(hit->head<2>())), Lit::bottom, world.cup.wall_albedo};
    }
    if (!wall) return std::nullopt;
    const Vector3 p = at(beam, *wall);
    if (p.z() > world.cup.height || p.z() < world.cup.bottom - world.cup.dish) return std::nullopt;
    return Landing{p, wall_normal(p), Lit::inner_wall, world.cup.wall_albedo};
  }

  /// Whether the straight way from a point in the cup, or on its rim's level, out to an eye passes the mouth.
  bool passes_mouth(const Vector3& point, const Vector3& eye) const {
    const double share = (world.cup.height - point.z()) / (eye.z() - point.z());
    return (point + share * (eye - point)).head<2>().operator-(axis).norm() <= world.cup.inner_radius;
  }
};

/// Whether the cup's outer wall stands between a point outside it and an eye.
bool hidden_by_cup(const Cup& cup, const Vector3& point, const Vector3& eye) {
  const Beam beam{point, (eye - point).normalized()};
  const auto entry = cylinder(beam, cup.centre, cup.outer_radius, false);
  return entry && *entry > 1e-6 && at(beam, *entry).z() < cup.height;
}

/// Lambert's share, and distance to the projector and back to the lens, beside the desk's straight below at 0.7 m.
double shade(const Landing& landing, const Vector3& lit_from) {
  const Vector3 to_light = lit_from - landing.point;
  return landing.albedo / kDeskAlbedo * std::max(0.0, landing.normal.dot(to_light.normalized())) * 0.49 /
         to_light.squaredNorm();
}

/// How far the nephroid of light that a round wall gathers on the bottom pulls a dot's middle [px]: towards its ridge.
double caustic_pull(const Cup& cup, const Vector3& point) {
  constexpr double kWidth = 0.003;
  const Vector2 from_focus = point.head<2>() - cup.centre - Vector2(0.2 * cup.inner_radius, 0.25 * cup.inner_radius);
  const double off = (from_focus.norm() - 0.5 * cup.inner_radius) / kWidth;
  return -cup.caustic * off * std::exp(-0.5 * off * off);
}

struct Follower {
  const World& world;
  const Eyes& eyes;
  const Dot& dot;
  std::vector<SeenDot>& seen;
  Cavity cavity{world, world.cup.centre};

  void see(const Vector3& towards, const Landing& landing, double brightness) const {
    Vector2 pixel = camera_pixel(eyes, world.sensor, towards - eyes.camera);
    if (world.cup.caustic != 0.0 && landing.lit == Lit::bottom) pixel.x() += caustic_pull(world.cup, landing.point);
    seen.push_back({pixel, disparity_seen(world.sensor, dot.at, pixel.x()), brightness, landing.lit, dot.number});
  }

  /// What stands in air: the desk, the cup's outside, its rim, its dry inside, an opaque liquid's top.
  void see_in_air(const Landing& landing, bool inside, double light) const {
    if (landing.normal.dot(eyes.camera - landing.point) <= 0.0) return;
    if (inside ? !cavity.passes_mouth(landing.point, eyes.camera)
               : landing.lit == Lit::desk && hidden_by_cup(world.cup, landing.point, eyes.camera))
      return;
    see(landing.point, landing, light * shade(landing, eyes.projector));
  }

  void see_through_liquid(const Landing& landing, const Vector3& entry, double light) const {
    const auto exit = least_path(world, eyes.camera, landing.point);
    if (!exit || is_foam(world, exit->head<2>() - cavity.axis) || !cavity.passes_mouth(*exit, eyes.camera)) return;
    const double in_liquid = (landing.point - entry).norm() + (landing.point - *exit).norm();
    const double cosine = (eyes.camera - *exit).normalized().z();
    const double back = 1.0 - fresnel(cosine, world.liquid->index);
    // n²: light that leaves a denser medium fills a wider cone.
    const double spread = 1.0 / (world.liquid->index * world.liquid->index);
    see(*exit, landing,
        light * back * spread * std::exp(-world.liquid->absorption * in_liquid) * shade(landing, eyes.projector));
  }

  void mirror_on_wall(const Vector3& surface, const Vector3& along, const Vector3& normal, double share) const {
    const Beam mirrored{surface, (along - 2.0 * along.dot(normal) * normal).normalized()};
    const auto wall = cylinder(mirrored, cavity.axis, world.cup.inner_radius, true);
    if (!wall) return;
    const Vector3 p = at(mirrored, *wall);
    if (p.z() < world.cup.height)
      see_in_air({p, cavity.wall_normal(p), Lit::inner_wall, world.cup.wall_albedo}, true, share);
  }

  void enter_liquid(const Beam& beam, const Vector3& surface) const {
    const Liquid& liquid = *world.liquid;
    const Vector2 place = surface.head<2>();
    const Vector3 normal = normal_of(cavity.top(place));
    if (is_foam(world, place - cavity.axis)) return;  // past its top, into its side: lost
    const double cosine = -beam.along.dot(normal), mirrored = fresnel(cosine, liquid.index);
    if (world.ghost_gain > 0.0) mirror_on_wall(surface, beam.along, normal, world.ghost_gain * mirrored);
    if (liquid.reduced_scattering > 0.0) {
      // Its last way, towards the camera, shifts light as its first one does.
      const Vector3 ways = beam.along + (eyes.camera - surface).normalized();
      const Vector3 tangential = ways - ways.dot(normal) * normal;
      const Vector3 shift = turbid_shift(liquid.index, liquid.reduced_scattering, kCoreMetres) * tangential;
      const double contrast = turbid_contrast(liquid.reduced_scattering, kCoreMetres);
      // What is absorbed on the way: some 3 free paths.
      const double kept = std::exp(-3.0 * liquid.absorption / liquid.reduced_scattering);
      return see_in_air({surface + shift, normal, Lit::surface, kMilkAlbedo}, true, (1.0 - mirrored) * contrast * kept);
    }
    const auto below = bent(beam.along, normal, 1.0, liquid.index);
    if (!below) return;
    Beam inside{surface, *below};
    const double layer = layer_height(world);
    if (liquid.deep_index_excess != 0.0 && surface.z() > layer) {
      const Vector3 turn = at(inside, (layer - surface.z()) / inside.along.z());
      const auto deeper = bent(inside.along, Vector3::UnitZ(), liquid.index, liquid.index + liquid.deep_index_excess);
      if ((turn.head<2>() - cavity.axis).norm() < world.cup.inner_radius && deeper) inside = {turn, *deeper};
    }
    const auto landing = cavity.land(inside);
    if (!landing) return;
    see_through_liquid(*landing, surface, 1.0 - mirrored);
    if (world.cup.wall_gloss > 0.0 && landing->lit == Lit::inner_wall) {
      const Vector3 on = inside.along - 2.0 * inside.along.dot(landing->normal) * landing->normal;
      if (const auto second = cavity.land({landing->point + 1e-6 * landing->normal, on}))
        see_through_liquid(*second, surface, (1.0 - mirrored) * world.cup.wall_gloss);
    }
  }

  std::optional<Landing> land_on_foam(const Beam& beam) const {
    if (world.top.foam_cover <= 0.0) return std::nullopt;
    const double thickness = world.top.foam_thickness;
    const auto point = meet(beam, world.cup.bottom + world.fill + thickness, [&](const Vector2& p) {
      Slope top = cavity.top(p);
      top.z += thickness;
      return top;
    });
    if (!point || (point->head<2>() - cavity.axis).norm() >= world.cup.inner_radius) return std::nullopt;
    if (!is_foam(world, point->head<2>() - cavity.axis)) return std::nullopt;
    return Landing{*point, Vector3::UnitZ(), Lit::surface, kFoamAlbedo};
  }

  void enter_cup(const Beam& beam) const {
    if (world.liquid && world.fill > 0.0) {
      if (const auto foam = land_on_foam(beam)) return see_in_air(*foam, true, 1.0);
      const auto surface = meet(beam, world.cup.bottom + world.fill, [&](const Vector2& p) { return cavity.top(p); });
      if (surface && (surface->head<2>() - cavity.axis).norm() < world.cup.inner_radius)
        return enter_liquid(beam, *surface);
    }
    const auto landing = cavity.land(beam);
    if (!landing) return;
    see_in_air(*landing, true, 1.0);
    if (world.cup.wall_gloss > 0.0 && landing->lit == Lit::inner_wall) {
      const Vector3 on = beam.along - 2.0 * beam.along.dot(landing->normal) * landing->normal;
      if (const auto second = cavity.land({landing->point + 1e-6 * landing->normal, on}))
        see_in_air(*second, true, world.cup.wall_gloss);
    }
  }
};

}  // namespace

void follow(const World& world, const Eyes& eyes, const Dot& dot, bool has_cup, std::vector<SeenDot>& seen) {
  const Beam beam{eyes.projector, projector_direction(eyes, dot.at)};
  if (beam.along.z() >= 0.0) return;
  const Follower follower{world, eyes, dot, seen};
  const Cup& cup = world.cup;
  if (has_cup) {
    const Vector3 mouth = at(beam, (cup.height - beam.from.z()) / beam.along.z());
    const double r = (mouth.head<2>() - cup.centre).norm();
    if (r <= cup.inner_radius) return follower.enter_cup(beam);
    if (r <= cup.outer_radius)
      return follower.see_in_air({mouth, Vector3::UnitZ(), Lit::rim, cup.wall_albedo}, false, 1.0);
    if (const auto wall = cylinder(beam, cup.centre, cup.outer_radius, false)) {
      const Vector3 p = at(beam, *wall);
      if (p.z() >= 0.0 && p.z() < cup.height)
        return follower.see_in_air({p, -follower.cavity.wall_normal(p), Lit::outer_wall, cup.wall_albedo}, false, 1.0);
    }
  }
  const Vector3 p = at(beam, -beam.from.z() / beam.along.z());
  if (has_cup)
    follower.see_in_air({p, Vector3::UnitZ(), Lit::desk, kDeskAlbedo}, false, 1.0);
  else {
    const Landing desk{p, Vector3::UnitZ(), Lit::desk, kDeskAlbedo};
    follower.see(p, desk, shade(desk, eyes.projector));
  }
}

}  // namespace fathom::blind
