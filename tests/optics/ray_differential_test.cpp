// Derivatives that a ray carries, against differences of rays traced through a sphere.
#include "sim/optics/ray_differential.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "sim/optics/snell.h"

namespace fathom {
namespace {

/// A sphere of radius 30 mm about the origin that the ray enters from above, and leaves below.
constexpr double kRadius = 0.030, kIndex = 1.5;
const Eigen::Vector3d kSource(0.004, -0.010, 0.200);

enum class Last { refract, reflect };

RayDifferential through_sphere(const Eigen::Vector3d& start, Last last) {
  RayDifferential differential = ray_differential_from(kSource, start);
  for (const bool entering : {true, false}) {
    const double along = differential.origin.dot(differential.direction);
    const double root = std::sqrt(along * along - differential.origin.squaredNorm() + kRadius * kRadius);
    const Eigen::Vector3d point = differential.origin + (-along + (entering ? -root : root)) * differential.direction;
    const double side = entering ? 1.0 : -1.0;
    const Eigen::Vector3d normal = side * point / kRadius;
    const Eigen::Matrix3d curvature = side * (Eigen::Matrix3d::Identity() - normal * normal.transpose()) / kRadius;
    advance(differential, point, normal);
    if (!entering && last == Last::reflect)
      reflect(differential, {normal, curvature});
    else
      EXPECT_TRUE(refract(differential, {normal, curvature}, entering ? 1.0 : kIndex, entering ? kIndex : 1.0));
  }
  return differential;
}

TEST(RayDifferential, DerivativesAreThoseOfDifferences) {
  const Eigen::Vector3d start = Eigen::Vector3d(0.03, 0.08, -1.0).normalized();
  const Matrix32d basis = perpendicular_to(start);
  for (const Last last : {Last::refract, Last::reflect}) {
    const RayDifferential differential = through_sphere(start, last);
    for (int axis = 0; axis < 2; ++axis) {
      const double step = 1e-5;
      const RayDifferential left = through_sphere((start - step * basis.col(axis)).normalized(), last);
      const RayDifferential right = through_sphere((start + step * basis.col(axis)).normalized(), last);
      // Central differences are good to step² times the third derivative, here of order 1e3 / rad³.
      EXPECT_LT((differential.d_origin.col(axis) - (right.origin - left.origin) / (2.0 * step)).norm(), 1e-7);
      EXPECT_LT((differential.d_direction.col(axis) - (right.direction - left.direction) / (2.0 * step)).norm(), 1e-6);
    }
  }
}

TEST(RayDifferential, FollowsSnellAsSingleRaysDo) {
  const Eigen::Vector3d direction = Eigen::Vector3d(0.6, 0.0, -0.8), up = Eigen::Vector3d::UnitZ();
  RayDifferential differential = ray_differential_from({0.0, 0.0, 0.8}, direction);
  advance(differential, {0.6, 0.0, 0.0}, up);
  ASSERT_TRUE(refract(differential, {up, Eigen::Matrix3d::Zero()}, 1.0, 1.33));
  EXPECT_LT((differential.direction - *refract(direction, up, 1.0, 1.33)).norm(), 1e-15);
  RayDifferential trapped = ray_differential_from({0.0, 0.0, 0.8}, direction);
  EXPECT_FALSE(refract(trapped, {up, Eigen::Matrix3d::Zero()}, 1.8, 1.0));  // beyond the critical angle
}

TEST(RayDifferential, WithoutAnInterfaceSpreadsAsTheInverseSquare) {
  const Landing landing = land(ray_differential_from({0.0, 0.0, 0.0}, Eigen::Vector3d::UnitX()), {2.0, 0.1, 0.0});
  EXPECT_NEAR(std::fabs(landing.jacobian.determinant()), 4.0, 1e-14);
  EXPECT_NEAR(landing.distance, 2.0, 1e-15);
  EXPECT_NEAR(landing.miss.norm(), 0.1, 1e-15);
}

}  // namespace
}  // namespace fathom
