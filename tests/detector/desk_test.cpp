// The robust method's desk: what lies flat on it is not it.
#include "detector/desk.h"

#include <gtest/gtest.h>

#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

TEST(Desk, WhatLiesFlatOnItDoesNotLiftIt) {
  synthetic::Scene scene;
  scene.noise_m = 0.0006;  // a simulated Xtion's
  scene.boxes = {{{-0.15, 0.25}, {0.0, 0.45}, 0.003}, {{0.05, 0.30}, {0.25, 0.40}, 0.004}};
  const auto found = find_desk(synthetic::cast(scene).points, scene.sensor, {});
  const PlaneFit desk = std::get<PlaneFit>(found);
  // A twentieth of a millimetre; the two of them have a tenth of the points, and would lift it by 0.3 mm.
  EXPECT_NEAR(desk.plane.offset, scene.sensor.height_m, 5e-5);
}

TEST(Desk, ABoxsFaceIsNoneForACameraThatHangsUpsideDown) {
  synthetic::Scene scene;
  scene.boxes = {{{-0.10, 0.35}, {0.10, 0.45}, 0.20}};
  Points points = synthetic::cast(scene).points;
  for (Eigen::Vector3f& point : points) point.head<2>() *= -1.0f;
  const PlaneFit desk = std::get<PlaneFit>(find_desk(points, std::nullopt, {}));
  EXPECT_NEAR(desk.plane.offset, scene.sensor.height_m, 1e-4);  // single precision
}

}  // namespace
}  // namespace fathom
