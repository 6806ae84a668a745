// Refraction and reflection of directions.
#include "sim/optics/snell.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/rng.h"

namespace fathom {
namespace {

constexpr double kRounding = 1e-15;  // a few roundings of numbers up to 1

Eigen::Vector3d random_direction(Rng& rng) {
  return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
}

struct Meeting {
  Eigen::Vector3d direction, normal;
};

/// A unit direction that meets a unit normal's side.
Meeting random_meeting(Rng& rng) {
  const Eigen::Vector3d normal = random_direction(rng);
  Eigen::Vector3d direction = random_direction(rng);
  if (direction.dot(normal) > 0.0) direction = -direction;
  return {direction, normal};
}

TEST(Snell, RefractionObeysSnellsLawInThePlaneOfIncidence) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const auto [direction, normal] = random_meeting(rng);
    const auto refracted = refract(direction, normal, 1.0, 1.328);
    ASSERT_TRUE(refracted);
    EXPECT_NEAR(refracted->norm(), 1.0, kRounding);
    EXPECT_LT(refracted->dot(normal), 0.0);
    // n sin θ as a vector: the tangential part is carried over, which is the law and the common plane in one.
    EXPECT_LT((direction.cross(normal) - 1.328 * refracted->cross(normal)).norm(), kRounding);
  }
}

TEST(Snell, TotalInternalReflectionHasNoRefractedRay) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double critical = std::asin(1.0 / 1.328);
  const auto from_below = [&](double angle) {
    return refract({std::sin(angle), 0.0, std::cos(angle)}, -up, 1.328, 1.0);
  };
  EXPECT_TRUE(from_below(critical - 1e-9));
  EXPECT_FALSE(from_below(critical + 1e-9));
  EXPECT_FALSE(from_below(1.5));
}

TEST(Snell, LightTakesTheSamePathBack) {
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const auto [direction, normal] = random_meeting(rng);
    if (direction.dot(normal) > -1e-2) continue;  // grazing: the way back starts next to total reflection
    const auto there = refract(direction, normal, 1.0, 1.328);
    const auto back = refract(-*there, -normal, 1.328, 1.0);
    ASSERT_TRUE(back);
    // The root of a cosine of 1e-2 loses two digits.
    EXPECT_LT((*back + direction).norm(), 1e-13);
  }
}

TEST(Snell, EqualIndicesDoNotBend) {
  Rng rng(3);
  const auto [direction, normal] = random_meeting(rng);
  EXPECT_LT((*refract(direction, normal, 1.4, 1.4) - direction).norm(), kRounding);
}

TEST(Snell, ReflectionKeepsTheTangentAndTurnsTheNormalPart) {
  Rng rng(4);
  const auto [direction, normal] = random_meeting(rng);
  const Eigen::Vector3d reflected = reflect(direction, normal);
  EXPECT_NEAR(reflected.dot(normal), -direction.dot(normal), kRounding);
  EXPECT_LT((reflected.cross(normal) - direction.cross(normal)).norm(), kRounding);
}

}  // namespace
}  // namespace fathom
