// Light through tilted, curved and walled liquids, against closed forms and against itself.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/rng.h"
#include "sim/optics/flat_refraction.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/snell.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

constexpr double kIndex = 1.3281, kGlass = 1.51, kLevel = kPaperCupBottom + 0.030;
const Eigen::Vector3d kAxis(0.0, 0.300, 0.0);

/// A point on the cup's bottom, not near its wall.
Eigen::Vector3d bottom_point(Rng& rng, double radius) {
  const double r = radius * std::sqrt(rng.uniform());
  const Eigen::Vector2d xy = r * direction_of(2.0 * std::numbers::pi * rng.uniform());
  return kAxis + Eigen::Vector3d(xy.x(), xy.y(), kPaperCupBottom);
}

const Body* liquid_of(const LitScene& scene) { return &scene.geometry.bodies.front(); }

TEST(TiltedSurface, IsTheFlatProblemTurned) {
  const LitScene scene(cup_of(kPaperCup, std::string(kWater) + kTilted));
  const Eigen::Vector2d rise = std::tan(radians_from_deg(8.0)) * direction_of(radians_from_deg(40.0));
  const Eigen::Vector3d normal = Eigen::Vector3d(-rise.x(), -rise.y(), 1.0).normalized();
  const Eigen::Vector3d on_plane = kAxis + Eigen::Vector3d(0.0, 0.0, kLevel), source = scene.projector.position();
  Rng rng(1);
  int connected = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point = bottom_point(rng, 0.035);
    const double height = normal.dot(source - on_plane), depth = normal.dot(on_plane - point);
    const Eigen::Vector3d foot = source - height * normal, across = point + depth * normal - foot;
    const FlatCrossing crossing = cross_flat_interface(height, depth, across.norm(), 1.0, kIndex);
    const Eigen::Vector3d bend = foot + crossing.offset * across.normalized();
    const auto ways = scene.connections(point, liquid_of(scene));
    if (ways.empty()) continue;  // in the shadow of the rim
    ++connected;
    ASSERT_EQ(ways.size(), 1u);
    EXPECT_LT((ways[0].direction - (bend - source).normalized()).norm(), 1e-12);  // roundings
    EXPECT_LT((ways[0].arrival - (point - bend).normalized()).norm(), 1e-12);
    EXPECT_NEAR(ways[0].spreading / flat_spreading(crossing, height, depth, 1.0, kIndex), 1.0, 1e-10);
    const double cosine = -normal.dot(ways[0].direction);
    EXPECT_NEAR(ways[0].transmittance,
                (1.0 - fresnel_reflectance(cosine, 1.0, kIndex)) * std::exp(-3.1 * (point - bend).norm()), 1e-12);
  }
  EXPECT_GT(connected, 150);
}

TEST(Spreading, IsTheAreaThatNeighbouringRaysEncloseOnTheBottom) {
  for (const char* surface : {kTilted, kMeniscus, kRippled})
    for (const char* shape : {kPaperCup, kGlassCup}) {
      const LitScene scene(cup_of(shape, std::string(kWater) + surface));
      // The bottom is a plane at which the rays may end whether it is clear or not.
      const auto landing = [&](const Eigen::Vector3d& direction) {
        Ray ray{scene.projector.position(), direction};
        BodySet inside = 0;
        for (;;) {
          const auto next = next_crossing(scene.world, ray, inside);
          if (!next || next->hit.point.z() < kPaperCupBottom + 1e-6) break;
          ray = {next->hit.point, *refract(ray.direction, next->hit.normal, index_of(next->from), index_of(next->to))};
          inside = next->beyond;
        }
        return Eigen::Vector3d(ray.origin +
                               (kPaperCupBottom - ray.origin.z()) / ray.direction.z() * ray.direction);
      };
      Rng rng(2);
      int ways_seen = 0;
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d point = bottom_point(rng, 0.038);
        for (const Connection& way : scene.connections(point, liquid_of(scene))) {
          EXPECT_LT((landing(way.direction) - point).norm(), 1e-9);  // what shooting calls a hit
          const Matrix32d basis = perpendicular_to(way.direction);
          const double step = 1e-6;
          Eigen::Matrix<double, 3, 2> moved;
          for (int axis = 0; axis < 2; ++axis)
            moved.col(axis) = (landing((way.direction + step * basis.col(axis)).normalized()) -
                               landing((way.direction - step * basis.col(axis)).normalized())) /
                              (2.0 * step);
          const double area = moved.col(0).cross(moved.col(1)).norm() * std::fabs(way.arrival.z());
          // Differences of 1 µrad: 1e-13 m of rounding over 1e-6 m, and step² times a third derivative that grows
          // towards caustics, where the area vanishes.
          EXPECT_NEAR(way.spreading * area, 1.0, 1e-5 * std::max(1.0, way.spreading)) << surface << shape;
          ++ways_seen;
        }
      }
      EXPECT_GT(ways_seen, 60) << surface << shape;
    }
}

TEST(Connections, AreTheSameBackwardsWithSpreadingByTheIndexSquared) {
  for (const char* surface : {kTilted, kMeniscus, kRippled})
    for (const char* shape : {kPaperCup, kGlassCup}) {
      const LitScene scene(cup_of(shape, std::string(kWater) + surface));
      Rng rng(3);
      int pairs = 0;
      for (int i = 0; i < 30; ++i) {
        const Eigen::Vector3d point = bottom_point(rng, 0.036) + Eigen::Vector3d(0.0, 0.0, 0.002);
        const Source back{point, scene.world.bodies_around(point)};
        ASSERT_EQ(medium_in(scene.geometry, back.inside), liquid_of(scene));
        for (const Connection& way : scene.connections(point, liquid_of(scene))) {
          const auto returned = shoot(scene.world, back, scene.projector.position(), nullptr, -way.arrival, way.crossings);
          ASSERT_TRUE(returned) << surface << shape;
          // A hit is within 1e-10 m; over the shortest piece, 30 mm, and with what a curved surface adds.
          EXPECT_LT((returned->direction + way.arrival).norm(), 1e-7);
          EXPECT_NEAR(returned->spreading * kIndex * kIndex / way.spreading, 1.0, 1e-6);
          EXPECT_NEAR(returned->transmittance / way.transmittance, 1.0, 1e-9);
          ++pairs;
        }
      }
      EXPECT_GT(pairs, 15) << surface << shape;
    }
}

/// The next crossing of a ray with an upright cylinder about the cup's axis.
double to_cylinder(const Ray& ray, double radius, bool entering) {
  const Eigen::Vector2d p = (ray.origin - kAxis).head<2>(), d = ray.direction.head<2>();
  const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - radius * radius;
  const double root = std::sqrt(b * b - a * c);
  return (-b + (entering ? -root : root)) / a;
}

TEST(GlassCup, FromTheSideBendsAtItsWallAndAtItsBottom) {
  const LitScene scene(cup_of(kGlassCup, kWater));
  Rng rng(4);
  int seen_through = 0;
  for (int i = 0; i < 300; ++i) {
    const double height = 0.012 + 0.02 * rng.uniform(), angle = -0.5 * std::numbers::pi + 0.8 * (rng.uniform() - 0.5);
    const Eigen::Vector2d out = direction_of(angle);
    Ray ray{scene.rig.camera_in_world(), {}};
    const Ray camera = scene.camera_ray(kAxis + Eigen::Vector3d(0.043 * out.x(), 0.043 * out.y(), height));
    ray.direction = camera.direction;
    const auto turn = [&](double distance, Eigen::Vector3d normal, double n_from, double n_to) {
      ray.origin += distance * ray.direction;
      if (normal.isZero()) normal = ((ray.origin - kAxis).cwiseProduct(Eigen::Vector3d(1, 1, 0))).normalized();
      ray.direction = *refract(ray.direction, normal, n_from, n_to);
      return distance;
    };
    const Eigen::Vector3d radial = Eigen::Vector3d::Zero(), up = Eigen::Vector3d::UnitZ();
    turn(to_cylinder(ray, 0.043, true), radial, 1.0, kGlass);
    double in_glass = turn(to_cylinder(ray, 0.040, true), radial, kGlass, kIndex);
    const double to_bottom = (kPaperCupBottom - ray.origin.z()) / ray.direction.z();
    if (to_cylinder(ray, 0.040, false) < to_bottom || ray.origin.z() > kLevel || ray.origin.z() < kPaperCupBottom)
      continue;
    const double in_water = turn(to_bottom, up, kIndex, kGlass);
    const double to_desk = -ray.origin.z() / ray.direction.z();
    in_glass += to_desk;
    const auto seen = see(scene.world, camera);
    ASSERT_TRUE(seen);
    ++seen_through;
    EXPECT_LT((seen->point - (ray.origin + to_desk * ray.direction)).norm(), 1e-12);  // roundings
    EXPECT_EQ(seen->around, &scene.geometry.bodies.back());
    EXPECT_TRUE(seen->refracted);
    EXPECT_LT(seen->transmittance, std::exp(-44.0 * in_glass - 3.1 * in_water) / (kGlass * kGlass));
    EXPECT_GT(seen->transmittance, 0.8 * std::exp(-44.0 * in_glass - 3.1 * in_water) / (kGlass * kGlass));
  }
  EXPECT_GT(seen_through, 100);
}

TEST(GlassCup, OfTheIndexOfTheLiquidInAPaperCupsPlaceIsNotThere) {
  // The wall wins over the liquid that reaches into it; with equal indices nothing bends between them.
  const std::string shape = R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43,
                                "material": {"index": 1.3281}})";
  const LitScene scene(cup_of(shape, kWater));
  const Ray ray = scene.camera_ray(kAxis + Eigen::Vector3d(0.005, 0.002, kLevel));
  const auto seen = see(scene.world, ray);
  ASSERT_TRUE(seen);
  const Eigen::Vector3d inside = *refract(ray.direction, Eigen::Vector3d::UnitZ(), 1.0, kIndex);
  const Eigen::Vector3d expected = kAxis + Eigen::Vector3d(0.005, 0.002, kLevel) - kLevel / inside.z() * inside;
  EXPECT_LT((seen->point - expected).norm(), 1e-12);
}

TEST(Mirrored, LightComesFromTheImageBelowALevelSurface) {
  const LitScene scene(cup_of(kPaperCup, kWater));
  const Eigen::Vector3d source = scene.projector.position();
  const Eigen::Vector3d image(source.x(), source.y(), 2.0 * kLevel - source.z());
  int ghosts = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d out = direction_of(std::numbers::pi * (0.25 + 0.5 * i / 40.0));
    const Eigen::Vector3d point = kAxis + Eigen::Vector3d(0.0399 * out.x(), 0.0399 * out.y(), kLevel + 0.020);
    scene.projector.connect_mirrored({point, nullptr}, [&](const Connection& way) {
      const Eigen::Vector3d path = point - image;
      EXPECT_LT((way.arrival - path.normalized()).norm(), 1e-9);  // what shooting calls a hit, 1e-10 m, over 20 mm
      EXPECT_NEAR(way.spreading * path.squaredNorm(), 1.0, 1e-9);
      EXPECT_NEAR(way.transmittance, fresnel_reflectance(way.arrival.z(), 1.0, kIndex), 1e-9);
      ++ghosts;
    });
  }
  EXPECT_GT(ghosts, 20);
}

}  // namespace
}  // namespace fathom
