#include "diagnosis/measurement/laboratory_rig.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/library.h"
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
  EXPECT_TRUE(is_same_cup(rig.cup, straight_cup(0.090, 0.006, 0.035, 0.038)));
  EXPECT_DOUBLE_EQ(rig.fill_sigma_m, 0.0004);
  EXPECT_EQ(rig.liquids.size(), 2u);
  EXPECT_EQ(rig.sigma.at("bottom_mm"), 0.1);
}

TEST(Rig, OnlyModelPoseCupAndLiquidsMustBeThere) {
  const LaboratoryRig rig =
      read(R"({"sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45}, "cup": {}, "liquids": {}})");
  EXPECT_TRUE(is_same_cup(rig.cup, straight_cup(0.087, 0.007, 0.040, 0.043)));
  EXPECT_DOUBLE_EQ(rig.baseline_m, 0.075);
  EXPECT_DOUBLE_EQ(rig.focal_px, 575.816);  // a Kinect's, 58.12 degrees of view
  const std::string sensor = R"("sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45})";
  EXPECT_EQ(error_of("{" + sensor + R"(, "cup": {}})"), "/liquids: is missing");
  EXPECT_EQ(error_of("{" + sensor + R"(, "liquids": {}})"), "/cup: is missing");
  EXPECT_EQ(error_of(R"({"sensor": {"model": "kinect_v1", "height_mm": 600}, "cup": {}, "liquids": {}})"),
            "/sensor/pitch_deg: is missing");
}

/// "cup": {…} at a sensor.
std::string with_cup(const std::string& cup) {
  return R"({"sensor": {"model": "kinect_v1", "height_mm": 600, "pitch_deg": 45}, "liquids": {}, "cup": {)" + cup +
         "}}";
}

TEST(Rig, EveryCupOfTheLibraryIsKnownByItsName) {
  for (const std::string& name : library_names("cups")) {
    const LaboratoryRig rig = read(with_cup(R"("shape": ")" + name + "\""));
    EXPECT_EQ(rig.cup_shape, name);
    EXPECT_EQ(rig.cup, library_cup(name));
  }
  EXPECT_TRUE(is_same_cup(read(with_cup(R"("shape": "mug")")).cup, straight_cup(0.095, 0.006, 0.035, 0.039)));
  EXPECT_DOUBLE_EQ(read(with_cup(R"("shape": "tapered_cup")")).cup.inner_radius(0.090), 0.038);
}

TEST(Rig, LengthsBesideAStraightCupOfTheLibraryStandForItsOwn) {
  EXPECT_TRUE(
      is_same_cup(read(with_cup(R"("shape": "mug", "bottom_mm": 8)")).cup, straight_cup(0.095, 0.008, 0.035, 0.039)));
}

/// Radii are those 45 mm above the desk, as campaigns write them; nobody could say where another one is.
TEST(Rig, LengthsBesideACupWhoseWallsLeanMustBeItsOwn) {
  const std::string tapered = R"("shape": "tapered_cup", "height_mm": 90, "bottom_mm": 4, )";
  EXPECT_EQ(read(with_cup(tapered + R"("inner_radius_mm": 31.72093, "outer_radius_mm": 33)")).cup,
            library_cup("tapered_cup"));
  EXPECT_EQ(error_of(with_cup(tapered + R"("outer_radius_mm": 34)")),
            "/cup/outer_radius_mm: must be 33 or left out: the walls of tapered_cup lean, its radii are those 45 mm "
            "above the desk; another cup takes inner_profile_mm and outer_profile_mm");
}

TEST(Rig, ALaboratorysOwnCupHasProfilesOrLengths) {
  const std::string profiles = R"("inner_profile_mm": [[0, 5], [20, 5], [30, 60]],
                                  "outer_profile_mm": [[0, 0], [22, 0], [32, 60]])";
  const LaboratoryRig rig = read(with_cup(profiles + R"(, "sigma": {"bottom_mm": 0.2})"));
  EXPECT_DOUBLE_EQ(rig.cup.height(), 0.060);
  EXPECT_DOUBLE_EQ(rig.cup.outer_radius(0.030), 0.027);
  EXPECT_EQ(rig.sigma.at("bottom_mm"), 0.2);
  EXPECT_EQ(read(with_cup(R"("shape": "mug", )" + profiles)).cup, rig.cup) << "the shape is but a name there";
  const std::string lengths = R"("height_mm": 60, "inner_radius_mm": 30, "outer_radius_mm": 32, "bottom_mm": 3)";
  EXPECT_TRUE(
      is_same_cup(read(with_cup(R"("shape": "beaker", )" + lengths)).cup, straight_cup(0.060, 0.003, 0.030, 0.032)));
  EXPECT_EQ(error_of(with_cup(profiles + R"(, "height_mm": 60)")),
            "/cup/height_mm: cannot stand beside a profile, which already says it");
  EXPECT_EQ(error_of(with_cup(R"("inner_profile_mm": [[0, 5], [20, 5], [30, 60]])")),
            "/cup/outer_profile_mm: is missing");
  EXPECT_EQ(error_of(with_cup(R"("shape": "beaker", "height_mm": 95)")),
            "/cup/bottom_mm: is missing: beaker is no cup of the library, whose lengths are known (mug, paper_cup, "
            "tapered_cup); inner_profile_mm and outer_profile_mm describe one whose walls lean");
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
  for (const char* inner : {R"("inner_radius_mm": 50)", R"("inner_radius_mm": 43)"})
    EXPECT_EQ(error_of(with(inner, "")), "/cup/outer_radius_mm: must be above inner_radius_mm");
  EXPECT_EQ(error_of(with(R"("bottom_mm": 0)", "")),
            "/cup/bottom_mm: must be a number above 0 and at most 2000, got 0");
  EXPECT_EQ(error_of(with(R"("bottom_mm": 87)", "")), "/cup/bottom_mm: must be below height_mm");
  EXPECT_EQ(error_of(with(R"("radius_mm": 40)", "")).find("/cup/radius_mm: unknown key 'radius_mm', choose from shape"),
            0u);
  EXPECT_EQ(error_of(with("", R"("none": "water")")), "/liquids/none: is a reserved name and no liquid");
  EXPECT_EQ(error_of(with("", R"("water": 1.33)")), "/liquids/water: must be a medium's name or an inline medium");
}

}  // namespace
}  // namespace fathom
