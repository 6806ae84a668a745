// Single dots in the infrared image, on the desk and under water: where they lie and how bright they are, against the
// exact refraction of a narrow beam.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sensor/sparse_dots.h"

namespace fathom {
namespace dots_test {

/// What a cup stands in front of the sensor with: its distance, and 30 mm of water that absorbs so much.
struct Condition {
  double distance_mm, absorption_per_mm;
};

class Dots : public testing::TestWithParam<Condition> {};

TEST_P(Dots, LieWhereRefractionPutsThemAndAreAsBright) {
  const SparseDots dots(GetParam().distance_mm, GetParam().absorption_per_mm);
  constexpr int kSamplesAcross = 2;  // as captures have it
  const Image<float> image = dots.image(kSamplesAcross);
  for (const auto& [name, ground] : {std::pair("desk", dots.desk()), std::pair("bottom", dots.bottom())}) {
    const std::vector<SparseDot> on_ground = dots.on(ground);
    double worst_place_ir_px = 0.0, worst_brightness = 0.0;
    for (const SparseDot& dot : on_ground) {
      const DotImage measured = measured_dot(image, dot.exact.centre_ir_px);
      worst_place_ir_px = std::max(worst_place_ir_px, (measured.centre_ir_px - dot.exact.centre_ir_px).norm());
      worst_brightness = std::max(worst_brightness, std::fabs(measured.sum_dn / dot.exact.sum_dn - 1.0));
    }
    RecordProperty(fmt::format("{}_dots", name), static_cast<int>(on_ground.size()));
    RecordProperty(fmt::format("{}_worst_place_ir_px", name), fmt::format("{:.4f}", worst_place_ir_px));
    RecordProperty(fmt::format("{}_worst_brightness", name), fmt::format("{:.5f}", worst_brightness));
    EXPECT_GE(on_ground.size(), 10u) << name;
    // Promised: 0.01 px. 2 × 2 samples a pixel are 0.5 px apart, against a standard deviation of 0.9 px: the aliasing
    // of a Gaussian, exp(−2 π² (0.9 / 0.5)²), is nothing. What remains: dots are read from a table to 1/1024 of a grid
    // step, 0.002 px; and where the brightness changes by 0.2 % a pixel, a dot's centre of light is off the image of
    // its centre by that share of its variance, 0.8 px².
    EXPECT_LT(worst_place_ir_px, 0.003) << name;
    // Promised: 0.2 % for the ratio of bottom and desk; here for either. The table changes a sample by up to 0.4 %, to
    // either side, and about 100 samples make a dot.
    EXPECT_LT(worst_brightness, 0.0005) << name;
  }
}

// Clear water, water as it is at 830 nm, and water that lets a quarter through.
INSTANTIATE_TEST_SUITE_P(Conditions, Dots,
                         testing::Values(Condition{200, 0.0}, Condition{200, 0.0031}, Condition{200, 0.02},
                                         Condition{300, 0.0}, Condition{300, 0.0031}, Condition{300, 0.02}),
                         [](const auto& instance) {
                           const Condition& condition = instance.param;
                           return fmt::format("{:g}mm_absorbing_{:g}_per_10m", condition.distance_mm,
                                              1e4 * condition.absorption_per_mm);
                         });

}  // namespace dots_test
}  // namespace fathom
