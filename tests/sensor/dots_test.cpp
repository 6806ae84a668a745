// Single dots in the infrared image, on the desk and under water: where they lie and how bright they are, against the
// exact refraction of a narrow beam.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/render/truth.h"
#include "sim/sensor/ir_camera.h"
#include "sim/sensor/pattern.h"
#include "tests/render/scenes.h"
#include "tests/sensor/exact_dot.h"

namespace fathom {
namespace {

/// Dots that are switched on stand this many grid steps apart, 12 infrared pixels.
constexpr int kSpacing = 6;
/// A dot ends two grid steps, 4 infrared pixels, from its centre; neither desk nor water stretch it by a tenth.
constexpr int kReachIrPx = 6;

/// Sum and first moment of the pixels around a place.
DotImage measured_dot(const Image<float>& image, const Eigen::Vector2d& near_ir_px) {
  DotImage dot{Eigen::Vector2d::Zero(), 0.0};
  const int x = static_cast<int>(near_ir_px.x()), y = static_cast<int>(near_ir_px.y());
  for (int j = y - kReachIrPx; j <= y + kReachIrPx; ++j)
    for (int i = x - kReachIrPx; i <= x + kReachIrPx; ++i) {
      dot.sum_dn += image(i, j);
      dot.centre_ir_px += image(i, j) * Eigen::Vector2d(i + 0.5, j + 0.5);
    }
  dot.centre_ir_px /= dot.sum_dn;
  return dot;
}

/// How far the dots of a kind lie off: the worst of each.
struct Deviations {
  int dots = 0;
  double place_ir_px = 0.0, brightness = 0.0;
};

/// What a cup stands in front of the sensor with: its distance, and 30 mm of water that absorbs so much.
struct Condition {
  double distance_mm, absorption_per_mm;
};

/// The paper's cup in the middle of the sensor's image, lit by few dots.
class SparseDots {
 public:
  explicit SparseDots(const Condition& condition) : view_(setup_of(condition)) {
    const SensorModel& sensor = view_.rig.sensor;
    Pattern pattern(sensor.pattern, sensor.ir_scale());
    std::vector<float> gains(static_cast<std::size_t>(pattern.columns()) * pattern.rows(), 0.0f);
    for (int row = 0; row < pattern.rows(); ++row)
      for (int column = 0; column < pattern.columns(); ++column)
        if (pattern.has_dot(column, row) && stands_alone(column, row)) {
          lit_.emplace_back(column, row);
          gains[static_cast<std::size_t>(row) * pattern.columns() + column] = 1.0f;
        }
    pattern.set_dot_gains(std::move(gains));
    middle_ = 0.5 * Eigen::Vector2d(pattern.columns() - 1, pattern.rows() - 1);
    constexpr int kSamplesAcross = 2;  // as captures have it
    image_ = render_ir(view_.projector, view_.rig, pattern, kSamplesAcross, LightModel::direct, 1);
    truth_ = trace_truth(view_.projector, view_.rig);
  }

  /// Of the dots that lie wholly on the ground, seen and lit.
  Deviations deviations(const Ground& ground) const {
    Deviations worst;
    for (const Eigen::Vector2i& dot : lit_) {
      const SensorModel& sensor = view_.rig.sensor;
      const Eigen::Vector2d direction = (dot.cast<double>() - middle_) * (sensor.pattern.step_px / sensor.focal_px);
      const DotImage exact = exact_dot(view_.rig, direction, ground);
      if (!on_ground(exact.centre_ir_px, ground)) continue;
      const DotImage measured = measured_dot(image_, exact.centre_ir_px);
      ++worst.dots;
      worst.place_ir_px = std::max(worst.place_ir_px, (measured.centre_ir_px - exact.centre_ir_px).norm());
      worst.brightness = std::max(worst.brightness, std::fabs(measured.sum_dn / exact.sum_dn - 1.0));
    }
    return worst;
  }

  Ground desk() const { return {0.0, 0.55}; }
  Ground bottom() const {
    const Turbid& water = view_.geometry.bodies.front().medium;
    return {kPaperCupBottom, 0.70, 0.030, water.n, water.absorption};
  }

 private:
  static Setup setup_of(const Condition& condition) {
    Setup setup = cup_setup(30.0, condition.distance_mm, condition.distance_mm,
                            R"(, "depth_size_px": [320, 240], "ir_size_px": [640, 512])");
    setup.scene.cups.front().filling->medium.absorption = per_metre_from_per_mm(condition.absorption_per_mm);
    return setup;
  }

  /// Takes dots row by row, where none of those taken before is near.
  bool stands_alone(int column, int row) const {
    return std::none_of(lit_.rbegin(), lit_.rend(), [&](const Eigen::Vector2i& other) {
      return std::abs(other.x() - column) < kSpacing && std::abs(other.y() - row) < kSpacing;
    });
  }

  bool on_ground(const Eigen::Vector2d& centre_ir_px, const Ground& ground) const {
    const SensorModel& sensor = view_.rig.sensor;
    const int reach = kReachIrPx / 2 + 1;
    const int x = static_cast<int>(centre_ir_px.x() / sensor.ir_scale());
    const int y = static_cast<int>((centre_ir_px.y() - sensor.ir_first_row()) / sensor.ir_scale());
    if (x < reach || y < reach || x >= sensor.width - reach || y >= sensor.height - reach) return false;
    for (int j = y - reach; j <= y + reach; ++j)
      for (int i = x - reach; i <= x + reach; ++i)
        if (!truth_(i, j).apparent_depth || std::fabs(truth_(i, j).position.z() - ground.z) > 1e-9) return false;
    return true;
  }

  LitScene view_;
  std::vector<Eigen::Vector2i> lit_;
  Eigen::Vector2d middle_;
  Image<float> image_;
  Image<TruePixel> truth_;
};

class Dots : public testing::TestWithParam<Condition> {};

TEST_P(Dots, LieWhereRefractionPutsThemAndAreAsBright) {
  const SparseDots dots(GetParam());
  for (const auto& [name, ground] : {std::pair("desk", dots.desk()), std::pair("bottom", dots.bottom())}) {
    const Deviations worst = dots.deviations(ground);
    RecordProperty(fmt::format("{}_dots", name), worst.dots);
    RecordProperty(fmt::format("{}_worst_place_ir_px", name), fmt::format("{:.4f}", worst.place_ir_px));
    RecordProperty(fmt::format("{}_worst_brightness", name), fmt::format("{:.5f}", worst.brightness));
    EXPECT_GE(worst.dots, 10) << name;
    // Promised: 0.01 px. 2 × 2 samples a pixel are 0.5 px apart, against a standard deviation of 0.9 px: the aliasing
    // of a Gaussian, exp(−2 π² (0.9 / 0.5)²), is nothing. What remains: dots are read from a table to 1/1024 of a grid
    // step, 0.002 px; and where the brightness changes by 0.2 % a pixel, a dot's centre of light is off the image of
    // its centre by that share of its variance, 0.8 px².
    EXPECT_LT(worst.place_ir_px, 0.003) << name;
    // Promised: 0.2 % for the ratio of bottom and desk; here for either. The table changes a sample by up to 0.4 %, to
    // either side, and about 100 samples make a dot.
    EXPECT_LT(worst.brightness, 0.0005) << name;
  }
}

// Clear water, water as it is at 830 nm, and water that lets a quarter through.
INSTANTIATE_TEST_SUITE_P(Conditions, Dots,
                         testing::Values(Condition{200, 0.0}, Condition{200, 0.0031}, Condition{200, 0.02},
                                         Condition{300, 0.0}, Condition{300, 0.0031}, Condition{300, 0.02}));

}  // namespace
}  // namespace fathom
