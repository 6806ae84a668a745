// Mirror images of a point of light: where they stand and how bright they are.
#include "sim/render/glint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/optics/fresnel.h"
#include "sim/optics/snell.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace glint_test {

constexpr double kLevel = kPaperCupBottom + 0.030, kIndex = 1.3281;
const Eigen::Vector3d kMiddle(0.0, 0.300, kLevel);

/// A cup of water with a surface of some kind.
struct Pool {
  explicit Pool(const char* surface)
      : geometry(build_geometry(
            cup_of(kPaperCup, fmt::format(R"(, "liquid": {{"index": {}}}, "fill_mm": 30{})", kIndex, surface)).scene,
            830.0)),
        world(geometry) {}

  std::vector<Connection> glints(const Eigen::Vector3d& light, const Eigen::Vector3d& eye) const {
    return find_glints(world, {light, 0}, eye);
  }

  Geometry geometry;
  Intersector world;
};

TEST(Glint, OfAPlaneIsThePlanesMirrorImage) {
  const double tilt = radians_from_deg(8.0), azimuth = radians_from_deg(40.0);
  const Eigen::Vector3d uphill(std::cos(azimuth), std::sin(azimuth), 0.0);
  const Eigen::Vector3d leaning = std::cos(tilt) * Eigen::Vector3d::UnitZ() - std::sin(tilt) * uphill;
  const Eigen::Vector3d light(0.05, 0.25, 0.6);
  for (const auto& [surface, normal] : {std::pair("", Eigen::Vector3d(Eigen::Vector3d::UnitZ())), {kTilted, leaning}}) {
    const Pool pool(surface);
    for (const Eigen::Vector3d& aside : {Eigen::Vector3d(0, 0, 0), {0.01, -0.01, 0}, {-0.02, 0.01, 0}}) {
      const Eigen::Vector3d on_surface = kMiddle + aside - aside.dot(normal) * normal;
      const Eigen::Vector3d arriving = (on_surface - light).normalized();
      const Eigen::Vector3d eye = on_surface + 0.7 * reflect(arriving, normal);
      const Eigen::Vector3d image = light - 2.0 * normal.dot(light - kMiddle) * normal;
      const std::vector<Connection> glints = pool.glints(light, eye);
      ASSERT_EQ(glints.size(), 1u) << surface;
      EXPECT_LT((glints[0].direction - arriving).norm(), 1e-12);
      EXPECT_LT((glints[0].arrival - (eye - image).normalized()).norm(), 1e-12);
      EXPECT_NEAR(glints[0].spreading * (eye - image).squaredNorm(), 1.0, 1e-12);
      EXPECT_NEAR(glints[0].transmittance, fresnel_reflectance(-arriving.dot(normal), 1.0, kIndex), 1e-12);
    }
    // Past the cup the plane goes on, the liquid does not.
    const Eigen::Vector3d outside = kMiddle + Eigen::Vector3d(0.06, 0.0, 0.0);
    const Eigen::Vector3d eye = outside + 0.7 * reflect((outside - light).normalized(), normal);
    EXPECT_TRUE(pool.glints(light, eye).empty()) << surface;
  }
}

TEST(Glint, OfAGlassPlateBothFacesHave) {
  // The bottom of an empty glass cup on nothing.
  constexpr double kGlass = 1.51, kThick = 0.007, kHeight = 0.5;
  auto setup = cup_of(R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43,
                           "material": {"index": 1.51}})",
                      "");
  setup.scene.desk.reset();
  const Geometry geometry = build_geometry(setup.scene, 830.0);
  const Intersector world(geometry);
  const Eigen::Vector3d light(0.03, 0.300, kThick + kHeight), eye(-0.03, 0.300, kThick + kHeight);
  const std::vector<Connection> glints = find_glints(world, {light, 0}, eye);
  const double across = (light - eye).norm();
  for (const double inside : {0.0, 2.0 * kThick}) {
    // By bisection, how steeply light starts that gets across on its way of so much height in air and glass.
    double low = 0.0, high = 1.0;
    const auto in_glass = [](double angle) { return std::asin(std::sin(angle) / kGlass); };
    const auto reach = [&](double angle) {
      return 2.0 * kHeight * std::tan(angle) + inside * std::tan(in_glass(angle));
    };
    for (int i = 0; i < 60; ++i) (reach(0.5 * (low + high)) < across ? low : high) = 0.5 * (low + high);
    const double slope = 2.0 * kHeight / std::pow(std::cos(low), 2.0) +
                         inside * std::cos(low) / (kGlass * std::pow(std::cos(in_glass(low)), 3.0));
    const double spreading = std::sin(low) / (across * slope * std::cos(low));  // sin θ dθ dφ over cos θ r dr dφ
    const double mirrored = fresnel_reflectance(std::cos(low), 1.0, kGlass);
    const double through = inside > 0.0 ? (1.0 - mirrored) * (1.0 - mirrored) : 1.0;
    const Eigen::Vector3d direction(-std::sin(low), 0.0, -std::cos(low));
    const auto found = std::find_if(glints.begin(), glints.end(), [&](const Connection& way) {
      return (way.direction - direction).norm() < 1e-9;  // 1e-10 m from 1 m away
    });
    ASSERT_NE(found, glints.end()) << inside;
    EXPECT_EQ(found->crossings, inside > 0.0 ? 3 : 1);
    EXPECT_NEAR(found->spreading / spreading, 1.0, 1e-8);
    EXPECT_NEAR(found->transmittance / (mirrored * through), 1.0, 1e-8);
  }
}

TEST(Glint, IsTheSameFromTheOtherEnd) {
  // Of wavy surfaces several. The ways are searched for from either end, by other rays.
  const Eigen::Vector3d light(0.0375, 0.28, 0.650), eye(-0.0375, 0.28, 0.650);
  for (const auto& [surface, least] : {std::pair(kMeniscus, 3u), {kRippled, 60u}}) {
    const Pool pool(surface);
    std::vector<Connection> there = pool.glints(light, eye), back = pool.glints(eye, light);
    for (auto* ways : {&there, &back})
      std::sort(ways->begin(), ways->end(),
                [](const Connection& a, const Connection& b) { return a.spreading < b.spreading; });
    EXPECT_GE(there.size(), least);
    ASSERT_EQ(there.size(), back.size()) << surface;
    for (std::size_t i = 0; i < there.size(); ++i) {
      // Either lands to 1e-10 m at worst, and curved surfaces magnify that.
      EXPECT_LT((there[i].direction + back[i].arrival).norm(), 1e-9);
      EXPECT_NEAR(there[i].spreading / back[i].spreading, 1.0, 1e-9);
      EXPECT_NEAR(there[i].transmittance, back[i].transmittance, 1e-9);
    }
  }
}

}  // namespace glint_test
}  // namespace fathom
