#include "blind/fermat.h"

#include <Eigen/LU>
#include <algorithm>

#include "blind/height_field.h"

namespace fathom::blind {
namespace {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

/// n₁ |a − t| + n₂ |t − b| with t on a level plane: convex in t, least by Newton's steps.
double length_through_layer(const Vector3& a, const Vector3& b, double z, double n1, double n2) {
  Vector2 t = (a + (b - a) * ((z - a.z()) / (b.z() - a.z()))).head<2>();
  for (int i = 0; i < 20; ++i) {
    const Vector3 p(t.x(), t.y(), z), to_a = p - a, to_b = p - b;
    const double la = to_a.norm(), lb = to_b.norm();
    const Vector2 ua = to_a.head<2>() / la, ub = to_b.head<2>() / lb;
    const Vector2 gradient = n1 * ua + n2 * ub;
    const Eigen::Matrix2d hessian = n1 / la * (Eigen::Matrix2d::Identity() - ua * ua.transpose()) +
                                    n2 / lb * (Eigen::Matrix2d::Identity() - ub * ub.transpose());
    const Vector2 step = hessian.inverse() * gradient;
    t -= step;
    if (step.norm() < 1e-10) break;
  }
  const Vector3 p(t.x(), t.y(), z);
  return n1 * (p - a).norm() + n2 * (p - b).norm();
}

double length_in_liquid(const World& world, const Vector3& surface, const Vector3& below) {
  const Liquid& liquid = *world.liquid;
  const double layer = layer_height(world);
  if (liquid.deep_index_excess == 0.0 || below.z() >= layer || surface.z() <= layer)
    return (liquid.index + (below.z() < layer ? liquid.deep_index_excess : 0.0)) * (surface - below).norm();
  return length_through_layer(surface, below, layer, liquid.index, liquid.index + liquid.deep_index_excess);
}

}  // namespace

double layer_height(const World& world) { return world.cup.bottom + 0.5 * world.fill; }

double optical_path(const World& world, const Vector3& above, const Vector2& crossing, const Vector3& below) {
  const Vector3 surface(crossing.x(), crossing.y(), liquid_top(world, crossing - world.cup.centre).z);
  return (surface - above).norm() + length_in_liquid(world, surface, below);
}

std::optional<Vector3> least_path(const World& world, const Vector3& above, const Vector3& below) {
  // A quadratic through nine lengths around the best crossing so far, its minimum, and again with a smaller stencil.
  constexpr double kSmallest = 2e-5;  // lengths are known to 1e-16 m: the minimum to well below 1e-6 m
  const double share = (world.cup.bottom + world.fill - below.z()) / (above.z() - below.z());
  Vector2 best = below.head<2>() + share * (above - below).head<2>();
  best += (0.25 * (below.head<2>() - best));  // bent towards the normal
  double h = 5e-4;
  for (int i = 0; i < 12; ++i) {
    const auto length = [&](double x, double y) {
      return optical_path(world, above, best + Vector2(x * h, y * h), below);
    };
    const double middle = length(0, 0), e = length(1, 0), w = length(-1, 0), n = length(0, 1), s = length(0, -1),
                 ne = length(1, 1), sw = length(-1, -1);
    const Vector2 gradient(0.5 * (e - w), 0.5 * (n - s));
    Eigen::Matrix2d hessian;
    hessian(0, 0) = e + w - 2.0 * middle;
    hessian(1, 1) = n + s - 2.0 * middle;
    hessian(0, 1) = hessian(1, 0) = 0.5 * (ne + sw - e - w - n - s + 2.0 * middle);
    if (!(hessian(0, 0) > 0.0) || !(hessian.determinant() > 0.0)) return std::nullopt;  // no minimum: a caustic
    Vector2 step = -h * (hessian.inverse() * gradient);
    if (step.norm() > 0.01) step *= 0.01 / step.norm();
    best += step;
    if ((best - world.cup.centre).norm() > world.cup.inner_radius + 0.01) return std::nullopt;
    if (h <= kSmallest && step.norm() < 1e-6) break;
    h = std::max(kSmallest, std::min(h, step.norm()));
  }
  const Vector2 place = best - world.cup.centre;
  if (place.norm() > world.cup.inner_radius) return std::nullopt;
  return Vector3(best.x(), best.y(), liquid_top(world, place).z);
}

}  // namespace fathom::blind
