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

  Ray operator()(double x, double y) const {
    return scene.camera_ray({kPixel * (x - kMiddle), 0.300 + kPixel * (y - kHeight / 2), 0.0});
  }
  std::optional<SeenPoint> seen(bool in_image, double x, double y) const {
    return in_image ? see_first_mirrored(scene.world, (*this)(x, y)) : see(scene.world, (*this)(x, y));
  }
  LitScene scene;
};

/// What is followed to places all over the strip, beside what a search finds there.
struct Tally {
  int places = 0, followed = 0;
  double searched = 0.0;              ///< [1/m²] light of all that is searched for at the places that are followed to
  double missed = 0.0, others = 0.0;  ///< the same of what only the search finds, and of what only following does

  /// Adds to `sum` the light of those ways that are not among `others`.
  static void add_light(const std::vector<Connection>& ways, const std::vector<Connection>& others, double& sum) {
    for (const Connection& way : ways)
      if (std::none_of(others.begin(), others.end(), [&](const Connection& other) {
            return other.crossings == way.crossings && (other.direction - way.direction).norm() < 1e-7;
          }))
        sum += way.spreading * way.transmittance;
  }
};

Tally tally_of(const Strip& strip, const NearbyWays& nearby, Ways ways, bool in_image) {
  Tally tally;
  const PointLight& projector = strip.scene.projector;
  for (double y = 0.75; y < kHeight; y += 7.5)
    for (double x = 0.25; x < kWidth; x += 0.5) {
      const auto seen = strip.seen(in_image, x, y);
      if (!seen) continue;
      ++tally.places;
      const Receiver receiver{seen->point, seen->around, &seen->normal};
      const auto starts = nearby.starts(ways, in_image, x, y, *seen);
      std::vector<Connection> found;
      if (!starts || !projector.follow(*starts, receiver, found)) continue;
      ++tally.followed;
      const std::vector<Connection> searched = projector.search(ways, receiver);
      Tally::add_light(searched, {}, tally.searched);
      Tally::add_light(searched, found, tally.missed);
      Tally::add_light(found, searched, tally.others);
    }
  return tally;
}

TEST(NearbyWays, AreAlmostAllThatASearchFindsAndNoOthers) {
  for (const char* surface : {"", kMeniscus, kRippled}) {
    const Strip strip(cup_of(kGlassCup, std::string(kWater) + surface));
    NearbyWays nearby(strip.scene.projector, std::cref(strip), kWidth, {true, true});
    nearby.prepare(0, kHeight);
    for (const bool in_image : {false, true})
      for (const Ways ways : {Ways::refracted, Ways::mirrored}) {
        const Tally tally = tally_of(strip, nearby, ways, in_image);
        const std::string which = fmt::format("{} {} {}", surface, in_image, static_cast<int>(ways));
        EXPECT_GT(tally.followed, tally.places / 2) << which;
        EXPECT_GT(tally.searched, 0.0) << which;
        EXPECT_LT(tally.missed, 0.01 * tally.searched) << which;
        EXPECT_LT(tally.others, 0.01 * tally.searched) << which;  // those that the search misses
      }
  }
}

TEST(NearbyWays, AreNotKnownOfAnotherSurfaceThanTheCornersSee) {
  const Strip strip(cup_of(kGlassCup, kWater));
  NearbyWays nearby(strip.scene.projector, std::cref(strip), kWidth, {false, false});
  nearby.prepare(0, kHeight);
  auto seen = strip.seen(false, 10.5, 10.5);
  ASSERT_TRUE(seen);
  EXPECT_TRUE(nearby.starts(Ways::refracted, false, 10.5, 10.5, *seen));
  seen->object += 1;
  EXPECT_FALSE(nearby.starts(Ways::refracted, false, 10.5, 10.5, *seen));
  seen = strip.seen(false, 20.5, 10.5);
  EXPECT_FALSE(nearby.starts(Ways::refracted, false, 10.5, 10.5, *seen));
}

}  // namespace
}  // namespace fathom
