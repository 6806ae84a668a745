// Where the sensor stands and what it is: conventions of the pose, descriptions that can be read back.
#include "sim/scene/rig.h"
#include "core/json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/expect_error.h"

namespace fathom {
namespace {

constexpr double kRounding = 1e-15;  // a few roundings of numbers below 1

Rig rig_of(const char* text) {
  const Json json = Json::parse(text);
  return rig_from_json(JsonReader(json, "test"));
}

TEST(Rig, AimAndPitchAgree) {
  const Rig aimed = rig_of(R"({"height_mm": 650, "aim_mm": [0, 400, 0]})");
  const Rig pitched = rig_of(R"({"height_mm": 650, "pitch_deg": 58.392497753751115})");  // atan(650/400)
  EXPECT_TRUE(aimed.world_from_camera.isApprox(pitched.world_from_camera, kRounding));
}

TEST(Rig, CameraStandsLeftAndProjectorRightOfTheOrigin) {
  for (const char* pose : {R"({"height_mm": 650, "aim_mm": [0, 400, 0]})", R"({"height_mm": 650, "pitch_deg": 90})",
                           R"({"height_mm": 650, "pitch_deg": 0})"}) {
    const Rig rig = rig_of(pose);
    EXPECT_LT((rig.camera_in_world() - Eigen::Vector3d(-0.0375, 0.0, 0.650)).norm(), kRounding);
    EXPECT_LT((rig.projector_in_world() - Eigen::Vector3d(0.0375, 0.0, 0.650)).norm(), kRounding);
  }
}

TEST(Rig, LooksWhereItAims) {
  const Rig rig = rig_of(R"({"height_mm": 650, "aim_mm": [120, 400, 80]})");
  const Eigen::Vector3d midpoint = 0.5 * (rig.camera_in_world() + rig.projector_in_world());
  const Eigen::Vector3d to_aim = (Eigen::Vector3d(0.120, 0.400, 0.080) - midpoint).normalized();
  EXPECT_LT((rig.world_from_camera.linear().col(2) - to_aim).norm(), kRounding);
  EXPECT_NEAR(rig.world_from_camera.linear()(2, 0), 0.0, kRounding);  // the baseline stays level
}

TEST(Rig, StraightDownTheImagesTopIsAway) {
  Eigen::Matrix3d expected;
  expected << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  for (const char* pose : {R"({"height_mm": 650, "pitch_deg": 90})", R"({"height_mm": 650, "aim_mm": [0, 0, 0]})"})
    EXPECT_LT((rig_of(pose).world_from_camera.linear() - expected).norm(), kRounding);
}

TEST(Rig, RollTurnsTheSensorClockwiseAboutItsAxis) {
  const Rig rig = rig_of(R"({"height_mm": 650, "pitch_deg": 40, "roll_deg": 10})");
  const Rig level = rig_of(R"({"height_mm": 650, "pitch_deg": 40})");
  // Seen from behind, the right side goes down; the line of sight stays.
  EXPECT_LT(rig.world_from_camera.linear()(2, 0), 0.0);
  EXPECT_LT((rig.world_from_camera.linear().col(2) - level.world_from_camera.linear().col(2)).norm(), kRounding);
}

TEST(Rig, FocalLengthFollowsFromTheZeroPlane) {
  EXPECT_NEAR(rig_of(R"({"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 60})").sensor.focal_px,
              1200.0 / (2.0 * 1.052), 1e-12);
  EXPECT_NEAR(rig_of(R"({"model": "kinect_v1", "height_mm": 650, "pitch_deg": 60})").sensor.focal_px,
              1200.0 / (2.0 * 1.042), 1e-12);
}

TEST(Rig, TheFirstPixelsCentreIsHalfAPixelIn) {
  const Rig rig = rig_of(R"({"height_mm": 650, "pitch_deg": 0})");
  EXPECT_LT((rig.direction_in_world(320.0, 240.0) - Eigen::Vector3d::UnitY()).norm(), kRounding);
  const Eigen::Vector3d right = rig.direction_in_world(320.0 + rig.sensor.focal_px, 240.0);
  EXPECT_LT((right - Eigen::Vector3d(1.0, 1.0, 0.0).normalized()).norm(), kRounding);
}

TEST(Rig, ADescriptionReadsBackAsTheSameRig) {
  for (const char* pose :
       {R"("aim_mm": [0, 400, 0])", R"("aim_mm": [120, 400, 80])", R"("pitch_deg": 90)", R"("pitch_deg": -10)",
        R"("pitch_deg": 58, "roll_deg": 7)", R"("pitch_deg": 90, "roll_deg": 20)",
        R"("pitch_deg": 30, "roll_deg": 170)", R"("aim_mm": [-200, 300, 0], "roll_deg": -12)"}) {
    const Rig rig = rig_of((std::string(R"({"model": "kinect_v1", "height_mm": 650, "noise": {"read_dn": 3},
        "quantization": "off", "optics": {"focus_mm": 1500}, "unit": {"serial": 5}, "pattern": {"seed": 7}, "matcher": {"window_rows": 7}, )") +
                            pose + "}")
                               .c_str());
    const Json json = json_from_rig(rig);
    const Rig again = rig_from_json(JsonReader(json, "test"));
    EXPECT_TRUE(again == rig) << pose << "\n" << json.dump();
    EXPECT_EQ(json_from_rig(again)["matcher"], json["matcher"]);
    for (const char* part : {"optics", "noise", "unit"}) EXPECT_EQ(json_from_rig(again)[part], json[part]);
    EXPECT_EQ(again.sensor.optics.focus, 1.5);
    EXPECT_EQ(again.sensor.unit.serial, 5u);
    EXPECT_EQ(again.sensor.pattern.seed, 7u);
    EXPECT_EQ(again.sensor.matcher.window_rows, 7);
    EXPECT_EQ(again.sensor.noise.read_dn, 3.0);
    EXPECT_FALSE(again.sensor.law.quantized);
    EXPECT_EQ(again.sensor.focal_px, rig.sensor.focal_px);
  }
}

TEST(Rig, APoseOfRowsIsATurnAndAPlaceAndStandsAlone) {
  const char* rows = R"([[1, 0, 0, -0.0375], [0, 0, 1, 0], [0, -1, 0, 0.65], [0, 0, 0, 1]])";
  const Rig level = rig_of(fmt::format(R"({{"world_from_camera": {}}})", rows).c_str());
  EXPECT_TRUE(level == rig_of(R"({"height_mm": 650, "pitch_deg": 0})"));
  for (const auto& [sensor, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {fmt::format(R"({{"world_from_camera": {}, "height_mm": 650}})", rows), "/height_mm: cannot stand beside"},
           {R"({"world_from_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]})", "must be 4 rows"},
           {R"({"world_from_camera": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})", "without stretching"},
           {R"({"world_from_camera": [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})", "mirroring"},
           {R"({"world_from_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]})",
            "/3: must be 0, 0, 0, 1"}})
    expect_error([&, &sensor = sensor] { rig_of(sensor.c_str()); }, {message});
}

TEST(Optics, UndistortedIsTheInverseOfDistorted) {
  OpticsModel optics;
  for (const double k1 : {-0.2, 0.1})
    for (const double x : {0.0, 0.3, -0.56}) {
      optics.camera_k1 = k1, optics.camera_k2 = 0.05;
      const Eigen::Vector2d direction(x, 0.42);  // the corner of the view is at 0.56, 0.42
      // Twenty rounds of a third each leave 3e-10 of it.
      EXPECT_LT((optics.undistorted(optics.distorted(direction)) - direction).norm(), 1e-9);
    }
}

TEST(Unit, DiffersFromOthersAndWarmsUp) {
  UnitModel unit;
  unit.disparity_sigma_px = 0.5;
  double sum = 0.0, squares = 0.0;
  constexpr int kUnits = 4000;
  for (int serial = 0; serial < kUnits; ++serial) {
    unit.serial = static_cast<std::uint64_t>(serial);
    const double offset = unit_error(unit, 0).offset_px;
    EXPECT_EQ(offset, unit_error(unit, 1000).offset_px);
    sum += offset, squares += offset * offset;
  }
  // 4 standard errors each.
  EXPECT_NEAR(sum / kUnits, 0.0, 4.0 * 0.5 / std::sqrt(kUnits));
  EXPECT_NEAR(squares / kUnits, 0.25, 4.0 * 0.25 * std::sqrt(2.0 / kUnits));

  UnitModel cold;
  cold.warm_up_px = 0.2, cold.warm_up_s = 600.0, cold.on_for_s = 0.0;
  EXPECT_DOUBLE_EQ(unit_error(cold, 0).offset_px, 0.2);
  EXPECT_DOUBLE_EQ(unit_error(cold, 30 * 600).offset_px, 0.2 / std::numbers::e);
}

/// A photometric capture with a pattern of 4000 × 4000 takes 395 MB more than one of 64 × 64.
TEST(Rig, APatternCountsByWhatShootingTakes) {
  expect_error(
      [] {
        rig_of(R"({"height_mm": 650, "pitch_deg": 60, "pattern": {"tile_columns": 512, "tile_rows": 512,
                   "tiles_across": 12, "tiles_down": 12}})");
      },
      {"/pattern: promises 1.06 GB of positions, at most 1 GB is read"});
}

}  // namespace
}  // namespace fathom
