// Light that a liquid's surface mirrors onto walls: where it comes from, and how much of it there is.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/estimate.h"
#include "core/rng.h"
#include "sim/optics/fresnel.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

constexpr double kIndex = 1.3281, kLevel = kPaperCupBottom + 0.030;
const Eigen::Vector3d kAxis(0.0, 0.300, 0.0);

TEST(Mirrored, LightComesFromTheImageBelowALevelSurface) {
  const LitScene scene(cup_of(kPaperCup, kWater));
  const Eigen::Vector3d source = scene.projector.position();
  const Eigen::Vector3d image(source.x(), source.y(), 2.0 * kLevel - source.z());
  Rng rng(1);
  int ghosts = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d out = direction_of(std::numbers::pi * (0.25 + 0.5 * i / 40.0));
    const Eigen::Vector3d point = kAxis + Eigen::Vector3d(0.0399 * out.x(), 0.0399 * out.y(), kLevel + 0.020);
    scene.projector.connect_mirrored({point, nullptr}, rng, [&](const Connection& way) {
      const Eigen::Vector3d path = point - image;
      EXPECT_LT((way.arrival - path.normalized()).norm(), 1e-9);  // what shooting calls a hit, 1e-10 m, over 20 mm
      EXPECT_NEAR(way.spreading * path.squaredNorm(), 1.0, 1e-9);
      EXPECT_NEAR(way.transmittance, fresnel_reflectance(way.arrival.z(), 1.0, kIndex), 1e-9);
      ++ghosts;
    });
  }
  EXPECT_GT(ghosts, 20);
}

/// A place drawn evenly from all of a scene's triangles of one object.
struct Place {
  Eigen::Vector3d point, normal;
};
class Places {
 public:
  Places(const Geometry& geometry, int object) {
    for (const Surface& surface : geometry.surfaces) {
      if (surface.object != object || !std::holds_alternative<Diffuse>(surface.optics)) continue;
      for (const Eigen::Vector3i& corner : surface.mesh.triangles) {
        const std::vector<Eigen::Vector3d>& vertices = surface.mesh.vertices;
        triangles_.push_back({vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]});
        const auto& [a, b, c] = triangles_.back();
        areas_.push_back(area() + 0.5 * (b - a).cross(c - a).norm());
      }
    }
  }

  double area() const { return areas_.empty() ? 0.0 : areas_.back(); }
  Place draw(Rng& rng) const {
    const auto at = std::upper_bound(areas_.begin(), areas_.end(), rng.uniform() * area()) - areas_.begin();
    const auto& [a, b, c] = triangles_[at];
    double u = rng.uniform(), v = rng.uniform();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    return {a + u * (b - a) + v * (c - a), (b - a).cross(c - a).normalized()};
  }

 private:
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
  std::vector<double> areas_;  ///< up to each triangle
};

TEST(Mirrored, LightOfAMeniscusIsAllThatItReflects) {
  const LitScene scene(cup_of(kPaperCup, std::string(kWater) + kMeniscus));
  const Eigen::Vector3d source = scene.projector.position();
  constexpr int kCup = 2;                  // after the desk
  constexpr double kLow = kLevel + 0.005;  // above the line of contact, near which the light piles up without bound
  Rng rng(8);
  // Forwards: of rays that leave the projector evenly in a cone around the liquid, what is reflected where they first
  // meet it, and where that ends.
  constexpr double kCone = 0.08;  // [rad] the liquid fills 0.12 in width
  const Eigen::Vector3d axis = (kAxis + Eigen::Vector3d(0.0, 0.0, kLevel) - source).normalized();
  const Matrix32d basis = perpendicular_to(axis);
  Mean thrown;
  for (int i = 0; i < 500'000; ++i) {
    const double cosine = 1.0 - rng.uniform() * (1.0 - std::cos(kCone));
    const Eigen::Vector2d aside =
        std::sqrt(1.0 - cosine * cosine) * direction_of(2.0 * std::numbers::pi * rng.uniform());
    Flight flight{pencil_from(source, cosine * axis + basis * aside), 0, 1.0};
    double power = 0.0;
    for (int crossings = 0; crossings < 8; ++crossings) {
      const Ray ray{flight.pencil.origin, flight.pencil.direction};
      const auto opaque = scene.world.first_opaque(ray);
      const auto next = next_crossing(scene.world, ray, flight.inside);
      if (!next || (opaque && opaque->distance < next->hit.distance)) {
        if (crossings > 0 && opaque && opaque->surface->object == kCup && opaque->point.z() > kLow)
          power = flight.transmittance;
        break;
      }
      pass(scene.world, *next, crossings == 0 ? Event::reflect : Event::refract, flight);
    }
    thrown.add(power);
  }
  const double solid_angle = 2.0 * std::numbers::pi * (1.0 - std::cos(kCone));

  // Backwards: from everywhere on the cup.
  const Places places(scene.geometry, kCup);
  Mean received;
  for (int i = 0; i < 600'000; ++i) {
    const Place place = places.draw(rng);
    double irradiance = 0.0;
    if (place.point.z() > kLow)
      scene.projector.connect_mirrored({place.point, nullptr, &place.normal}, rng, [&](const Connection& way) {
        irradiance -= way.transmittance * way.spreading * place.normal.dot(way.arrival);
      });
    received.add(irradiance);
  }
  const double expected = solid_angle * thrown.estimate().value, found = places.area() * received.estimate().value;
  const double error =
      std::hypot(solid_angle * thrown.estimate().standard_error, places.area() * received.estimate().standard_error);
  EXPECT_LT(error, 0.015 * expected);
  EXPECT_NEAR(found, expected, 4.0 * error);  // wrong once in 16000 seeds; this one is fixed
}

}  // namespace
}  // namespace fathom
