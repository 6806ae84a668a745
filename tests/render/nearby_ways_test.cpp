// Ways that are followed from points beside a place are those that a search finds there.
#include "sim/render/nearby_ways.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/render/scenes.h"

namespace fathom {
namespace {

constexpr int kWidth = 400, kHeight = 60, kMiddle = 200;  // [px]
constexpr double kPixel = 4e-4;                           ///< [m] on the desk

/// Looks from the camera at a strip of the desk through the cup's middle.
struct Strip {
  explicit Strip(const Setup& setup) : scene(setup) {}

  std::optional<SeenPoint> operator()(double x, double y) const {
    const Eigen::Vector3d at(kPixel * (x - kMiddle), 0.300 + kPixel * (y - kHeight / 2), 0.0);
    return see(scene.world, scene.camera_ray(at));
  }
  LitScene scene;
};

double light_of(const Connection& way) { return way.spreading * way.transmittance; }

TEST(NearbyWays, AreAlmostAllThatASearchFindsAndNoOthers) {
  for (const char* surface : {"", kMeniscus, kRippled}) {
    const Strip strip(cup_of(kGlassCup, std::string(kWater) + surface));
    NearbyWays nearby(strip.scene.projector, std::cref(strip), kWidth, true);
    nearby.prepare(0, kHeight);
    for (const Ways ways : {Ways::refracted, Ways::mirrored}) {
      double searched = 0.0, missed = 0.0, others = 0.0;
      int places = 0, followed = 0;
      for (double y = 0.75; y < kHeight; y += 7.5)
        for (double x = 0.25; x < kWidth; x += 0.5) {
          const auto seen = strip(x, y);
          if (!seen) continue;
          const Receiver receiver{seen->point, seen->around, &seen->normal};
          ++places;
          const auto starts = nearby.starts(ways, x, y, *seen);
          std::vector<Connection> found, expected = strip.scene.projector.search(ways, receiver);
          if (!starts || !strip.scene.projector.follow(*starts, receiver, found)) continue;
          ++followed;
          const auto in = [](const std::vector<Connection>& all, const Connection& way) {
            return std::any_of(all.begin(), all.end(), [&](const Connection& other) {
              return other.crossings == way.crossings && (other.direction - way.direction).norm() < 1e-7;
            });
          };
          for (const Connection& way : expected) {
            searched += light_of(way);
            if (!in(found, way)) missed += light_of(way);
          }
          for (const Connection& way : found)
            if (!in(expected, way)) others += light_of(way);
        }
      EXPECT_GT(followed, places / 2) << surface;
      EXPECT_GT(searched, 0.0);
      EXPECT_LT(missed, 0.01 * searched) << surface << static_cast<int>(ways);
      EXPECT_LT(others, 0.01 * searched) << surface << static_cast<int>(ways);  // those that the search misses
    }
  }
}

TEST(NearbyWays, AreNotKnownOfAnotherSurfaceThanTheCornersSee) {
  const Strip strip(cup_of(kGlassCup, kWater));
  NearbyWays nearby(strip.scene.projector, std::cref(strip), kWidth, false);
  nearby.prepare(0, kHeight);
  auto seen = strip(10.5, 10.5);
  ASSERT_TRUE(seen);
  EXPECT_TRUE(nearby.starts(Ways::refracted, 10.5, 10.5, *seen));
  seen->object += 1;
  EXPECT_FALSE(nearby.starts(Ways::refracted, 10.5, 10.5, *seen));
  seen = strip(20.5, 10.5);
  EXPECT_FALSE(nearby.starts(Ways::refracted, 10.5, 10.5, *seen));
}

}  // namespace
}  // namespace fathom
