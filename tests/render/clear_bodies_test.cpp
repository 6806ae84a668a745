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
namespace clear_bodies_test {

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
  EXPECT_GT(connected, 50);
}

TEST(Spreading, IsTheAreaThatNeighbouringRaysEncloseOnTheBottom) {
  for (const char* surface : {kTilted, kMeniscus, kRippled})
    for (const char* shape : {kPaperCup, kGlassCup}) {
      const LitScene scene(cup_of(shape, std::string(kWater) + surface));
      // The bottom is a plane at which the rays may end whether it is clear or not.
      int chain = 0;  // interfaces that the last ray crossed
      const auto landing = [&](const Eigen::Vector3d& direction) {
        Ray ray{scene.projector.position(), direction};
        BodySet inside = 0;
        chain = 0;
        for (;; ++chain) {
          const auto next = next_crossing(scene.world, ray, inside);
          if (!next || next->hit.point.z() < kPaperCupBottom + 1e-6) break;
          const auto bent = refract(ray.direction, next->hit.normal, index_of(next->from), index_of(next->to));
          ray = {next->hit.point, bent ? *bent : reflect(ray.direction, next->hit.normal)};
          inside = bent ? next->beyond : next->before;
        }
        return Eigen::Vector3d(ray.origin + (kPaperCupBottom - ray.origin.z()) / ray.direction.z() * ray.direction);
      };
      Rng rng(2);
      int ways_seen = 0, grazing = 0;
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d point = bottom_point(rng, 0.038);
        for (const Connection& way : scene.connections(point, liquid_of(scene))) {
          const Eigen::Vector3d landed = landing(way.direction);
          if (chain != way.crossings) {  // a ray along a wall, which rounding lets in or out
            ++grazing;
            continue;
          }
          EXPECT_LT((landed - point).norm(), 1e-9);  // what shooting calls a hit
          const Matrix32d basis = perpendicular_to(way.direction);
          bool same_chain = true;  // not so where an edge comes between the neighbours
          const auto area = [&](double step) {
            Matrix32d moved;
            for (int axis = 0; axis < 2; ++axis) {
              const Eigen::Vector3d after = landing((way.direction + step * basis.col(axis)).normalized());
              same_chain = same_chain && chain == way.crossings;
              const Eigen::Vector3d before = landing((way.direction - step * basis.col(axis)).normalized());
              same_chain = same_chain && chain == way.crossings;
              moved.col(axis) = (after - before) / (2.0 * step);
            }
            return moved.col(0).cross(moved.col(1)).norm() * std::fabs(way.arrival.z());
          };
          // Halving the step takes away three quarters of a difference's error; what is left is a third of the change.
          // Landings of 1e-15 m over steps of 1e-6 are good to 1e-6 where light spreads over 1e-3 m² and less.
          const double coarse = area(2e-6), fine = area(1e-6);
          if (!same_chain) continue;
          EXPECT_NEAR(way.spreading * fine, 1.0, way.spreading * std::fabs(coarse - fine) + 1e-6) << surface << shape;
          ++ways_seen;
        }
      }
      EXPECT_GT(ways_seen, 30) << surface << shape;
      EXPECT_LE(grazing, 1) << surface << shape;
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
          const auto returned =
              shoot(scene.world, back, scene.projector.position(), nullptr, -way.arrival, way.crossings);
          ASSERT_TRUE(returned) << surface << shape;
          // A hit is within 1e-10 m; over the shortest piece, 30 mm, and with what a curved surface adds.
          EXPECT_LT((returned->direction + way.arrival).norm(), 1e-7);
          EXPECT_NEAR(returned->spreading * kIndex * kIndex / way.spreading, 1.0, 1e-6);
          EXPECT_NEAR(returned->transmittance / way.transmittance, 1.0, 1e-9);
          ++pairs;
        }
      }
      EXPECT_GT(pairs, 8) << surface << shape;
    }
}

/// How many ways lead to each of `points` on the bottom, by brute force: of a grid of rays, those cells that land
/// around the point.
std::vector<int> count_ways(const LitScene& scene, const std::vector<Eigen::Vector3d>& points) {
  constexpr double kStep = 2e-4, kHalf = 0.075;  // [rad] the cup is 0.12 wide
  constexpr int kAcross = static_cast<int>(2.0 * kHalf / kStep);
  const Eigen::Vector3d source = scene.projector.position();
  const Eigen::Vector3d axis = (kAxis + Eigen::Vector3d(0.0, 0.0, kLevel) - source).normalized();
  const Matrix32d basis = perpendicular_to(axis);
  const auto row_of = [&](int j) {
    std::vector<std::optional<Eigen::Vector2d>> row(kAcross);
    for (int i = 0; i < kAcross; ++i) {
      const Eigen::Vector2d angles(i * kStep - kHalf, j * kStep - kHalf);
      const auto end = see(scene.world, {source, (axis + basis * angles).normalized()});
      if (end && end->refracted && std::fabs(end->point.z() - kPaperCupBottom) < 1e-9) row[i] = end->point.head<2>();
    }
    return row;
  };
  const auto holds = [](const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                        const Eigen::Vector2d& c) {
    const auto side = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      return (to - from).x() * (p - from).y() - (to - from).y() * (p - from).x() > 0.0;
    };
    return side(a, b) == side(b, c) && side(b, c) == side(c, a);
  };
  std::vector<int> ways(points.size());
  auto above = row_of(0);
  for (int j = 1; j < kAcross; ++j) {
    const auto below = row_of(j);
    for (int i = 1; i < kAcross; ++i) {
      if (!above[i - 1] || !above[i] || !below[i - 1] || !below[i]) continue;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Eigen::Vector2d p = points[k].head<2>();
        ways[k] += holds(p, *above[i - 1], *above[i], *below[i]) + holds(p, *above[i - 1], *below[i], *below[i - 1]);
      }
    }
    above = below;
  }
  return ways;
}

TEST(Connections, AreAlmostAllThatBruteForceFinds) {
  for (const char* surface : {kMeniscus, kRippled}) {
    const LitScene scene(cup_of(kPaperCup, std::string(kWater) + surface));
    Rng rng(5);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 100; ++i) points.push_back(bottom_point(rng, 0.0399));
    const std::vector<int> ways = count_ways(scene, points);
    int expected = 0, missed = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int found = static_cast<int>(scene.connections(points[i], liquid_of(scene)).size());
      expected += ways[i];
      missed += std::max(0, ways[i] - found);
    }
    EXPECT_GT(expected, 50);
    RecordProperty("missed_percent", fmt::format("{:.1f}", 100.0 * missed / expected));
    // Cells of 0.13 mm at a caustic's edge may hold a point that the caustic itself does not reach.
    EXPECT_LE(missed, expected / 50) << missed << " of " << expected << surface;
  }
}

/// The next crossing of a ray with an upright cylinder about the cup's axis.
double to_cylinder(const Ray& ray, double radius, bool entering) {
  const Eigen::Vector2d p = (ray.origin - kAxis).head<2>(), d = ray.direction.head<2>();
  const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - radius * radius;
  const double root = std::sqrt(b * b - a * c);
  return (-b + (entering ? -root : root)) / a;
}

TEST(Connections, JustUnderASurfaceAreOneToEachPlace) {
  for (const char* surface : {kTilted, kMeniscus, kRippled}) {
    const LitScene scene(cup_of(kPaperCup, std::string(kWater) + surface));
    Rng rng(6);
    for (const double depth : {5e-6, 5e-5, 5e-4})
      for (int i = 0; i < 100; ++i) {
        Eigen::Vector3d point = bottom_point(rng, 0.036);
        const auto top = scene.world.first_interface({point, Eigen::Vector3d::UnitZ()});
        ASSERT_TRUE(top);
        const Eigen::Vector3d nearer = top->point - Eigen::Vector3d(0.0, 0.001, 0.0);
        // Not in the rim's shadow, nor on its edge, which lies a little differently under the surface.
        if (scene.world.occluded(nearer, scene.projector.position())) continue;
        point.z() = top->point.z() - depth;
        EXPECT_EQ(scene.connections(point, liquid_of(scene)).size(), 1u) << surface << depth;
      }
  }
}

TEST(GlassCup, FromTheSideBendsAtItsWallAndAtItsBottom) {
  const LitScene scene(cup_of(kGlassCup, kWater));
  Rng rng(4);
  int seen_through = 0;
  for (int i = 0; i < 300; ++i) {
    const double height = 0.012 + 0.02 * rng.uniform(), angle = -0.5 * std::numbers::pi + 0.8 * (rng.uniform() - 0.5);
    const Eigen::Vector2d out = direction_of(angle);
    const Ray camera = scene.camera_ray(kAxis + Eigen::Vector3d(0.043 * out.x(), 0.043 * out.y(), height));
    Ray ray = camera;
    double through = 1.0;
    const auto turn = [&](double distance, Eigen::Vector3d normal, double n_from, double n_to) {
      ray.origin += distance * ray.direction;
      if (normal.isZero()) normal = ((ray.origin - kAxis).cwiseProduct(Eigen::Vector3d(1, 1, 0))).normalized();
      through *= 1.0 - fresnel_reflectance(-ray.direction.dot(normal), n_from, n_to);
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
    EXPECT_NEAR(seen->transmittance, through * std::exp(-44.0 * in_glass - 3.1 * in_water) / (kGlass * kGlass), 1e-12);
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

TEST(Cups, FilledToTheBrimStillHaveTheirRims) {
  for (const char* shape : {kPaperCup, kGlassCup}) {
    const LitScene scene(cup_of(shape, R"(, "liquid": {"index": 1.3281}, "fill_mm": 80)"));
    for (int degree = 0; degree < 360; ++degree) {
      const double azimuth = radians_from_deg(degree),
                   radius = 0.0411;  // where the liquid's disc reaches into the wall
      const auto hit = scene.world.first_hit(
          {{radius * std::cos(azimuth), 0.300 + radius * std::sin(azimuth), 0.200}, -Eigen::Vector3d::UnitZ()});
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->point.z(), 0.087, 1e-12);
      const auto* interface = std::get_if<Interface>(&hit->surface->optics);
      EXPECT_TRUE(!interface || interface->body == 1) << shape << degree;
    }
  }
}

TEST(ClearCups, OfBulgingProfilesAreClosedAndSoAreTheirLiquids) {
  // Filled to a belly, below a waist, at it, and above: surfaces that rise, sink and tilt at walls that lean both ways.
  const std::string shape = R"({"inner_profile_mm": [[0, 4], [16, 4], [30, 20], [20, 40], [32, 60], [24, 80]],
      "outer_profile_mm": [[0, 0], [18, 0], [18, 4], [32, 20], [22, 40], [34, 60], [26, 80]],
      "material": {"index": 1.51}})";
  const std::string sinking = R"(, "surface": {"contact_angle_deg": 125, "capillary_length_mm": 2.73})";
  constexpr int kRays = 20000;
  // A ray that passes a corner by less than the clearance of rays misses one of its sides: circles of 150 mm seen 4 µm
  // wide among 60 mm × 80 mm, for some ten corners.
  constexpr double kAtCorners = 1e-3;
  for (const double fill_mm : {8.0, 30.0, 35.9, 36.1, 60.0})
    for (const std::string& surface : {std::string(kMeniscus), std::string(kTilted), std::string(kRippled), sinking}) {
      const std::string liquid = fmt::format(R"(, "liquid": {{"index": 1.33}}, "fill_mm": {}{})", fill_mm, surface);
      const LitScene scene(cup_of(shape, liquid));
      const Body* glass = &scene.geometry.bodies.back();
      Rng rng(4);
      const auto somewhere = [&]() -> Eigen::Vector3d {
        return kAxis +
               Eigen::Vector3d(0.06 * (rng.uniform() - 0.5), 0.06 * (rng.uniform() - 0.5), 0.09 * rng.uniform());
      };
      int lost = 0,
          bare = 0;  // rays that leave a body without being in it; those that see where a liquid ends in a wall
      for (int i = 0; i < kRays; ++i) {
        const Eigen::Vector3d at = somewhere(), direction = (somewhere() - somewhere()).normalized();
        Ray ray{at - 0.2 * direction, direction};
        BodySet inside = 0;
        bool keeps_track = true, in_wall = true;
        while (const auto hit = scene.world.first_interface(ray)) {
          const BodySet body = BodySet{1} << std::get<Interface>(hit->surface->optics).body;
          keeps_track &= hit->entering == ((inside & body) == 0);
          const bool shell = body == 1 && std::holds_alternative<Facets>(hit->surface->shape);
          in_wall &= !shell || medium_in(scene.geometry, inside) == glass;
          inside = beyond(*hit, inside);
          ray.origin = hit->point;
        }
        lost += !keeps_track || inside != 0;
        bare += keeps_track && !in_wall;
      }
      EXPECT_LT(lost, kAtCorners * kRays) << fill_mm << surface;
      EXPECT_EQ(bare, 0) << fill_mm << surface;
    }
}

TEST(LiquidsAboveEachOther, BothBendTheLight) {
  // A cup of one liquid that stands at the bottom of a bowl of another.
  const LitScene scene(setup_from_json(Json::parse(R"({"sensor": {"height_mm": 650, "aim_mm": [0, 300, 0]}, "cups": [
      {"shape": {"height_mm": 60, "bottom_mm": 5, "inner_radius_mm": 70, "outer_radius_mm": 75}, "position_mm": [0, 300],
       "liquid": {"index": 1.3281}, "fill_mm": 50},
      {"shape": {"height_mm": 45, "bottom_mm": 10, "inner_radius_mm": 30, "outer_radius_mm": 33},
       "position_mm": [0, 300], "liquid": {"index": 1.5}, "fill_mm": 20}]})"),
                                       "test"));
  int lit = 0;
  for (double x = -0.020; x < 0.021; x += 0.005) {
    const auto seen = see(scene.world, scene.camera_ray({x, 0.300, 0.005}));
    ASSERT_TRUE(seen);
    if (std::fabs(seen->point.z() - 0.010) > 1e-9) continue;
    for_each_illumination(scene.projector, alone(*seen), [&](std::size_t, const Illumination& light) {
      const auto end = see(scene.world, {scene.projector.position(), light.direction});
      ASSERT_TRUE(end);
      EXPECT_LT((end->point - seen->point).norm(), 1e-9);  // what shooting calls a hit, 1e-10 m, on a slope
      ++lit;
    });
  }
  EXPECT_GE(lit, 5);
}

}  // namespace clear_bodies_test
}  // namespace fathom
