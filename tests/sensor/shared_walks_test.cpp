// Pixels that share walks see the light that each of them sees by walks of its own, and the dots where they are.
#include "sim/sensor/shared_walks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/render/light_walk.h"
#include "sim/render/radiance.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

constexpr int kSamples = 4;  ///< of a pixel, as captures take them

/// Means over pixels: of the light, of what of it lies on the dots as a bare surface would show them, and of what lies
/// on their right more than on their left, and on their lower more than on their upper side.
using DottedLight = Eigen::Array4d;

class Cup {
 public:
  explicit Cup(const std::string& filling) : scene_(cup_of(kPaperCup, filling)) {}

  struct Pixel {
    int x, y;
    std::array<SeenPoint, kSamples> seen;
  };

  /// Every `stride`-th pixel of a part, along rows and columns; all its samples lie in it.
  template <class Part>
  std::vector<Pixel> pixels(int stride, const Part& part) const {
    const SensorModel& sensor = scene_.rig.sensor;
    const double px_per_ir_px = 1.0 / sensor.ir_scale();
    std::vector<Pixel> result;
    for (int y = 0; y < sensor.ir_height; y += stride)
      for (int x = 0; x < sensor.ir_width; x += stride) {
        Pixel pixel{x, y, {}};
        int inside = 0;
        for (int i = 0; i < kSamples; ++i) {
          const Eigen::Vector3d direction =
              scene_.rig.direction_in_world((x + 0.25 + 0.5 * (i % 2)) * px_per_ir_px,
                                            (y - sensor.ir_first_row() + 0.25 + 0.5 * (i / 2)) * px_per_ir_px);
          const auto seen = see(scene_.world, {scene_.rig.camera_in_world(), direction});
          if (!seen || !part(*seen)) break;
          pixel.seen[i] = *seen, ++inside;
        }
        if (inside == kSamples) result.push_back(pixel);
      }
    return result;
  }

  bool is_lit(const Eigen::Vector3d& point) const { return !scene_.world.occluded(point, scene_.projector.position()); }

  /// Of the rows of some pixels, which are in order.
  SharedWalks shared(const std::vector<Pixel>& pixels, std::uint64_t seed) const {
    const int first = pixels.front().y, end = pixels.back().y + 1;
    SharedWalks walks = unprepared(seed, end - first);
    walks.prepare(first, end);
    return walks;
  }

  SharedWalks unprepared(std::uint64_t seed, int rows_at_once) const {
    return {scene_.projector, scene_.rig, blurred_, kFineSharing, seed, rows_at_once};
  }

  /// `radiance(pixel, sample)`.
  template <class Radiance>
  DottedLight light(const std::vector<Pixel>& pixels, const Radiance& radiance) const {
    DottedLight sum = DottedLight::Zero();
    for (const Pixel& pixel : pixels)
      for (int i = 0; i < kSamples; ++i) {
        const Eigen::Vector3d way = (pixel.seen[i].point - scene_.projector.position()).normalized();
        const Eigen::Vector2d place = *on_grid(pattern_, scene_.rig, way);
        const auto dots = [&](double right, double down) {
          return pattern_.intensity(place + Eigen::Vector2d(right, down));
        };
        sum += radiance(pixel, i) *
               DottedLight(1.0, dots(0, 0), dots(0.5, 0) - dots(-0.5, 0), dots(0, 0.5) - dots(0, -0.5));
      }
    return sum / (kSamples * static_cast<double>(pixels.size()));
  }

  /// Radiance [DN] by walks that nothing is shared of.
  double unshared(const SeenPoint& seen, Rng& rng, int walks) const {
    double sum = 0.0;
    for (int walk = 0; walk < walks; ++walk)
      walk_light(scene_.projector, seen, rng, [&](const ReturnedLight& light) {
        sum += radiance_dn(scene_.rig.sensor, light.reflected) * intensity_around(blurred_, scene_.rig, light);
      });
    return sum / walks;
  }

 private:
  LitScene scene_;
  Pattern pattern_{scene_.rig.sensor.pattern, scene_.rig.sensor.ir_scale()};
  BlurredPattern blurred_{pattern_};
};

double from_axis(const SeenPoint& seen) { return std::hypot(seen.point.x(), seen.point.y() - 0.3); }

constexpr const char* kMilkTea = R"(, "liquid": "milk_tea", "fill_mm": 20)";

struct Compared {
  DottedLight shared = DottedLight::Zero(), unshared = DottedLight::Zero();
};

/// With `walks` of its own for each sample, and as many `seeds` of the shared ones.
template <class Part>
Compared compared(const Cup& cup, int stride, int walks, const Part& part, int seeds = 2) {
  const std::vector<Cup::Pixel> pixels = cup.pixels(stride, part);
  Compared light;
  for (int seed = 1; seed <= seeds; ++seed) {
    const SharedWalks shared = cup.shared(pixels, seed);
    int missing = 0;
    light.shared += cup.light(pixels, [&](const Cup::Pixel& pixel, int sample) {
      if (const auto radiance =
              shared.radiance(SharedWalks::straight, pixel.x, pixel.y, sample, kSamples, pixel.seen[sample]))
        return *radiance;
      ++missing;
      Rng rng(1 + seed, pixel.y, pixel.x * kSamples + sample);
      return cup.unshared(pixel.seen[sample], rng, walks);
    }) / seeds;
    EXPECT_LT(missing, kSamples * static_cast<int>(pixels.size()) / 3);
  }
  light.unshared = cup.light(pixels, [&](const Cup::Pixel& pixel, int sample) {
    Rng rng(1, pixel.y, pixel.x * kSamples + sample);
    return cup.unshared(pixel.seen[sample], rng, walks);
  });
  return light;
}

// The seeds are fixed. Chance makes a third of what is allowed, or less: another seed of the walks changes the light by
// 1 %, and what lies on the dots by 3 %.
constexpr double kLight = 0.04, kDots = 0.10;

void expect_as_bright(const Compared& light, const DottedLight& full) {
  EXPECT_NEAR(light.shared[0], light.unshared[0], kLight * full[0]);
  EXPECT_NEAR(light.shared[1], light.unshared[1], kDots * full[1]);
}

void expect_alike(const Compared& light) {
  expect_as_bright(light, light.unshared);
  for (int i = 2; i < 4; ++i) EXPECT_NEAR(light.shared[i], light.unshared[i], kDots * light.unshared[1]) << i;
}

TEST(SharedWalks, LeaveTheLightOfMilkTeaWhereItIs) {
  const Cup cup(kMilkTea);
  const Compared light =
      compared(cup, 4, 60, [](const SeenPoint& seen) { return seen.entered && from_axis(seen) < 0.03; });
  expect_alike(light);
}

TEST(SharedWalks, LeaveItBesideTheWallWhereItIs) {
  const Cup cup(kMilkTea);
  const Compared light =
      compared(cup, 1, 20, [](const SeenPoint& seen) { return seen.entered && from_axis(seen) > 0.0375; });
  expect_alike(light);
}

TEST(SharedWalks, LeaveTheEdgeOfAShadowSharp) {
  const Cup cup(R"(, "liquid": "whole_milk", "fill_mm": 20)");
  constexpr double kBeside = 0.0025;  // [m]
  const auto beside_edge = [&](const SeenPoint& seen, bool lit) {
    const Eigen::Vector3d aside(kBeside, 0.0, 0.0);
    return seen.entered && from_axis(seen) < 0.036 && cup.is_lit(seen.point) == lit &&
           (cup.is_lit(seen.point + aside) != lit || cup.is_lit(seen.point - aside) != lit);
  };
  // A strip this narrow has few walks, which all its pixels share: a seed changes its light by 6 %.
  constexpr int kSeeds = 12;
  const Compared lit = compared(
      cup, 1, 24, [&](const SeenPoint& seen) { return beside_edge(seen, true); }, kSeeds);
  const Compared dark = compared(cup, 1, 24, [&](const SeenPoint& seen) { return beside_edge(seen, false); });
  EXPECT_LT(dark.unshared[1], 0.5 * lit.unshared[1]);
  expect_as_bright(lit, lit.unshared);
  expect_as_bright(dark, lit.unshared);
}

TEST(SharedWalks, LeaveLightThrownFromWallToWallWhereItIs) {
  const Cup cup(kMilkTea);
  const auto is_wall = [](const SeenPoint& seen) {
    return !seen.entered && seen.object > 1 && from_axis(seen) < 0.0401 && seen.point.z() > 0.032;
  };
  const Compared light = compared(cup, 4, 60, is_wall, 12);
  EXPECT_NEAR(light.shared[0], light.unshared[0], kLight * light.unshared[0]);
}

TEST(SharedWalks, AreTheSameInBandsOfAnyHeight) {
  const Cup cup(kMilkTea);
  const std::vector<Cup::Pixel> pixels =
      cup.pixels(3, [](const SeenPoint& seen) { return seen.entered && from_axis(seen) < 0.02; });
  const SharedWalks whole = cup.shared(pixels, 1);
  const int first = pixels.front().y, end = pixels.back().y + 1;
  constexpr int kRows = 7;
  SharedWalks bands = cup.unprepared(1, kRows);
  std::size_t next = 0;
  for (int top = first; top < end; top += kRows) {
    bands.prepare(top, std::min(top + kRows, end));
    for (; next < pixels.size() && pixels[next].y < top + kRows; ++next) {
      const Cup::Pixel& at = pixels[next];
      const auto of_band = bands.radiance(SharedWalks::straight, at.x, at.y, 0, kSamples, at.seen[0]);
      ASSERT_TRUE(of_band);
      EXPECT_EQ(of_band, whole.radiance(SharedWalks::straight, at.x, at.y, 0, kSamples, at.seen[0]));
    }
  }
  EXPECT_EQ(next, pixels.size());
}

TEST(SharedWalks, AreNotSharedWhereDotsAreSeenThroughALiquid) {
  const Cup cup(
      R"(, "liquid": {"index": 1.33, "absorption_per_mm": 0.003, "scattering_per_mm": 0.05, "anisotropy": 0.9},
                     "fill_mm": 20)");
  const std::vector<Cup::Pixel> pixels = cup.pixels(20, [](const SeenPoint& seen) { return seen.entered != nullptr; });
  ASSERT_FALSE(pixels.empty());
  const SharedWalks shared = cup.shared(pixels, 1);
  for (const Cup::Pixel& pixel : pixels)
    EXPECT_FALSE(shared.radiance(SharedWalks::straight, pixel.x, pixel.y, 0, kSamples, pixel.seen[0]));
}

}  // namespace
}  // namespace fathom
