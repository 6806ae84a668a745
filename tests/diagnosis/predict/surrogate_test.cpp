// The few rays of the surrogate against whole geometric frames, under the same estimators.
#include "diagnosis/predict/surrogate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "diagnosis/measurement/named_values.h"
#include "sim/sensor/capture.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

struct Case {
  const char* liquid;
  double fill_mm, distance_mm, lateral_mm;
  Json effects;
};

std::vector<SensedPoint> points_of(const Image<CloudPoint>& cloud) {
  std::vector<SensedPoint> points;
  for (const CloudPoint& p : cloud.pixels())
    if (p.z == p.z) points.push_back({{p.x, p.y, p.z}, p.intensity});
  return points;
}

class SurrogateAgainstFrames : public testing::TestWithParam<Case> {};

TEST_P(SurrogateAgainstFrames, SaysWhatTheFrameSays) {
  const Case& c = GetParam();
  const LaboratoryRig rig = paper_laboratory();
  Factors factors;
  factors.liquid = c.liquid;
  factors.fill_mm = c.fill_mm;
  factors.distance_mm = c.distance_mm;
  factors.lateral_mm = c.lateral_mm;
  const fathom::Setup setup = paper_setup(factors, c.effects);
  const Eigen::Vector2d place(metres_from_mm(c.lateral_mm), metres_from_mm(c.distance_mm));
  Camera camera(setup, CaptureMode::geometric, 1, 1);
  const auto frame = estimate_frame(points_of(camera.shoot(0).cloud), rig, {place, 0.0});
  const auto few = surrogate_frame(setup, rig, place, sample_pixels(rig, place));
  ASSERT_TRUE(frame && few);
  // Heights: the task of the surrogate. A region's border cuts pixels of 1.3 mm, and a wall's shadow as well.
  constexpr double kHeightMm = 0.05;
  // The plane: a frame has the desk's finite size and the cup's shadow, which matter where distortion bends it.
  constexpr double kDeskMm = 0.03;
  for (std::size_t i = 0; i < frame->height.size(); ++i) {
    if (frame->height[i].weight < 60.0) continue;  // a sliver at the wall's shadow: few rays, and half of them grazing
    EXPECT_NEAR(mm_from_metres(few->height[i].mean), mm_from_metres(frame->height[i].mean), kHeightMm)
        << kCupRegionNames[i] << " of " << frame->height[i].weight << " pixels";
    EXPECT_NEAR(few->height[i].weight / frame->height[i].weight, 1.0, 0.15) << kCupRegionNames[i];
  }
  EXPECT_NEAR(mm_from_metres(few->desk.offset), mm_from_metres(frame->desk.offset), kDeskMm);
  EXPECT_NEAR(pitch_above(few->desk), pitch_above(frame->desk), radians_from_deg(0.003));
}

INSTANTIATE_TEST_SUITE_P(
    Frames, SurrogateAgainstFrames,
    testing::Values(Case{"empty", 0, 200, 0, {}}, Case{"empty", 0, 400, 0, {}}, Case{"water", 10, 300, 0, {}},
                    Case{"water", 30, 200, 0, {}}, Case{"water", 30, 400, 0, {}}, Case{"water", 30, 500, 0, {}},
                    Case{"water", 20, 400, 150, {}}, Case{"milk", 20, 300, 0, {}}, Case{"milk", 30, 500, -100, {}},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "sensor_pitch", "pitch_deg": 0.5}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "baseline", "baseline_mm": 0.5}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "focal_length", "focal_px": 3}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "radial_distortion", "k1": 0.01}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "surface_tilt", "slope_x_deg": 1}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "meniscus", "contact_angle_deg": 30}])")},
                    Case{"milk", 30, 300, 0, Json::parse(R"([{"name": "meniscus", "contact_angle_deg": 30}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "ripples", "amplitude_mm": 0.1}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "stratification", "index_step": 0.05}])")},
                    Case{"empty", 0, 300, 0, Json::parse(R"([{"name": "concave_bottom", "depth_mm": 2}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "concave_bottom", "depth_mm": 1}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "window_averaging", "window_px": 9}])")}));

}  // namespace
}  // namespace fathom
