#include "diagnosis/measurement/rig.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/units.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

LaboratoryRig read(const std::string& json) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "rig_test.json";
  write_text(path, json);
  return read_rig(path);
}

std::string error_of(const std::string& json) {
  try {
    read(json);
  } catch (const Error& problem) {
    const std::string text = problem.what();
    return text.substr(text.find("rig_test.json: ") + 15);
  }
  return "";
}

TEST(Rig, EveryKeyIsReadInSi) {
  const LaboratoryRig rig = read(R"({
    "sensor": {"model": "xtion_pro_live", "height_mm": 640, "pitch_deg": 58.4, "roll_deg": 0.5, "baseline_mm": 74,
               "focal_px": 571, "disparity_offset_px": 0.1, "sigma": {"height_mm": 0.5, "pitch_deg": 0.05}},
    "cup": {"shape": "mug", "height_mm": 90, "inner_radius_mm": 35, "outer_radius_mm": 38, "bottom_mm": 6, "sigma": {"bottom_mm": 0.1}},
    "liquids": {"water": "water", "milk_tea": {"index": 1.336}}, "fill_sigma_mm": 0.4, "placement_sigma_mm": 0.6})");
  EXPECT_DOUBLE_EQ(rig.height_m, 0.640);
  EXPECT_DOUBLE_EQ(rig.pitch_rad, radians_from_deg(58.4));
  EXPECT_DOUBLE_EQ(rig.roll_rad, radians_from_deg(0.5));
  EXPECT_DOUBLE_EQ(rig.baseline_m, 0.074);
  EXPECT_DOUBLE_EQ(rig.focal_px, 571.0);
  EXPECT_DOUBLE_EQ(rig.disparity_offset_px, 0.1);
  EXPECT_DOUBLE_EQ(rig.outer_radius_m, 0.038);
  EXPECT_DOUBLE_EQ(rig.bottom_m, 0.006);
  EXPECT_DOUBLE_EQ(rig.fill_sigma_m, 0.0004);
  EXPECT_EQ(rig.liquids.size(), 2u);
  EXPECT_EQ(rig.sigma.at("bottom_mm"), 0.1);
}

TEST(Rig, OnlyModelPoseCupAndLiquidsMustBeThere) {
  const LaboratoryRig rig =
      read(R"({"sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45}, "cup": {}, "liquids": {}})");
  EXPECT_DOUBLE_EQ(rig.inner_radius_m, 0.040);
  EXPECT_DOUBLE_EQ(rig.baseline_m, 0.075);
  EXPECT_DOUBLE_EQ(rig.focal_px, 575.816);  // a Kinect's, 58.12 degrees of view
  const std::string sensor = R"("sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45})";
  EXPECT_EQ(error_of("{" + sensor + R"(, "cup": {}})"), "/liquids: is missing");
  EXPECT_EQ(error_of("{" + sensor + R"(, "liquids": {}})"), "/cup: is missing");
  EXPECT_EQ(error_of(R"({"sensor": {"model": "kinect_v1", "height_mm": 600}, "cup": {}, "liquids": {}})"),
            "/sensor/pitch_deg: is missing");
}

TEST(Rig, OfAnotherCupThanThePapersAllLengthsAreNeeded) {
  const std::string sensor = R"({"sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45}, "liquids": {}, )";
  EXPECT_EQ(error_of(sensor + R"("cup": {"shape": "mug", "height_mm": 95}})"),
            "/cup/inner_radius_mm: is missing: only of the paper_cup are the lengths known");
}

TEST(Rig, TheSensorStandsAboveTheCup) {
  EXPECT_EQ(error_of(R"({"sensor": {"model": "kinect_v1", "height_mm": 0.65, "pitch_deg": 45}, "cup": {},
                         "liquids": {}})"),
            "/sensor/height_mm: must be above 87, the height of the cup, got 0.65");
}

TEST(Rig, WhatCannotBeIsRefused) {
  const auto with = [](const std::string& cup, const std::string& liquids) {
    return R"({"sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45}, "cup": {)" + cup +
           R"(}, "liquids": {)" + liquids + "}}";
  };
  EXPECT_EQ(error_of(with(R"("inner_radius_mm": 50)", "")), "/cup/inner_radius_mm: must not be above outer_radius_mm");
  EXPECT_EQ(error_of(with(R"("bottom_mm": 87)", "")), "/cup/bottom_mm: must be below height_mm");
  EXPECT_EQ(error_of(with(R"("radius_mm": 40)", "")).find("/cup/radius_mm: unknown key 'radius_mm', choose from shape"),
            0u);
  EXPECT_EQ(error_of(with("", R"("none": "water")")), "/liquids/none: is a reserved name and no liquid");
  EXPECT_EQ(error_of(with("", R"("water": 1.33)")), "/liquids/water: must be a medium's name or an inline medium");
}

}  // namespace
}  // namespace fathom
