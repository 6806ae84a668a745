#include "sim/sensor/depth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom {
namespace {

constexpr double kFocalPx = 570.342, kBaseline = 0.075;  // an Xtion's [px, m]
constexpr int kWidth = 640;

/// Length of the run of holes that ends before, or begins at, column x.
int holes(const Image<float>& depth, int x, int step) {
  int count = 0;
  for (; x >= 0 && x < depth.width() && depth(x, 0) == 0.0f; x += step) ++count;
  return count;
}

TEST(Registration, SplitsAShadowAsTheCamerasStand) {
  constexpr double kNear = 0.6, kFar = 0.7;
  const double parallax_px = kFocalPx * (1.0 / kNear - 1.0 / kFar);  // per metre of baseline
  // As the infrared camera sees an object before a wall: all of the projector's shadow on the left.
  Image<float> depth(kWidth, 1, static_cast<float>(kFar));
  const int left = 300, right = 400, shadow = static_cast<int>(std::lround(parallax_px * kBaseline));
  for (int x = left; x < right; ++x) depth(x, 0) = static_cast<float>(kNear);
  for (int x = left - shadow; x < left; ++x) depth(x, 0) = 0.0f;

  const Image<float> registered = registered_to_colour(depth, kFocalPx, kFocalPx);
  int first = 0, last = 0;
  for (int x = 0; x < registered.width(); ++x)
    if (registered(x, 0) == static_cast<float>(kNear)) last = x, first = first > 0 ? first : x;
  EXPECT_EQ(last - first + 1, right - left);
  EXPECT_NEAR(first, left - kFocalPx * kColourCamera / kNear, 1.0);  // whole pixels
  // The projector stands 50 mm to the right of the colour camera, the infrared camera 25 mm to its left.
  EXPECT_NEAR(holes(registered, first - 1, -1), parallax_px * 0.050, 1.5);  // three places are rounded to whole pixels
  EXPECT_NEAR(holes(registered, last + 1, 1), parallax_px * 0.025, 1.0);
}

TEST(Registration, AShorterFocalLengthDrawsTheImageTogetherRoundItsMiddle) {
  constexpr int kHeight = 480;
  const Image<float> depth(kWidth, kHeight, 1000.0f);  // [m]: no parallax
  const Image<float> registered = registered_to_colour(depth, kFocalPx, kColourFocalPx);
  const double margin = 0.5 * kHeight * (1.0 - kColourFocalPx / kFocalPx);
  int empty = 0;
  while (registered(kWidth / 2, empty) == 0.0f) ++empty;
  EXPECT_NEAR(empty, margin, 1.0);  // whole pixels
  EXPECT_EQ(registered(kWidth / 2, kHeight - 1 - empty), 1000.0f);
}

TEST(Registration, TheNearestPointWins) {
  const auto place = [](int x, float z) {
    return static_cast<int>(std::floor(x + 0.5 - kFocalPx * kColourCamera / z));
  };
  const float near = 0.6f, far = 2.0f;
  const int near_x = 320, far_x = near_x + place(near_x, near) - place(near_x, far);
  Image<float> depth(kWidth, 1);
  depth(near_x, 0) = near;
  depth(far_x, 0) = far;
  ASSERT_EQ(place(far_x, far), place(near_x, near));
  EXPECT_EQ(registered_to_colour(depth, kFocalPx, kFocalPx)(place(near_x, near), 0), near);
}

}  // namespace
}  // namespace fathom
