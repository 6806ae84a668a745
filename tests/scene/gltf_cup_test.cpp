// Cups from glTF files in scene files: where they stand, how they are filled, and one line for what cannot be.
#include <gtest/gtest.h>

#include <chrono>

#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/cup_mesh.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"
#include "tests/render/gltf_slab.h"
#include "tests/scene/vessels.h"
#include "tests/scene/write_gltf.h"

namespace fathom {
namespace {

class GltfCup : public testing::Test {
 protected:
  GltfCup() {
    const Json name = "paper_cup";
    Mesh mesh = cup_mesh(cup_shape_from_json(JsonReader(name, "test")));
    for (Eigen::Vector3d& v : mesh.vertices) v.z() += 0.5;  // the file's own height does not matter
    write_gltf(folder_ / "cup.gltf", mesh);
  }

  Cup read(const char* keys, const char* file = "cup.gltf") {
    Json cup = Json::parse(keys);
    cup["shape"] = file;
    return cup_from_json(JsonReader(cup, (folder_ / "scene.json").string(), "/cups/0"));
  }

  TemporaryFolder folder_;
};

// Coordinates of the file are floats: 0.587 m is rounded by up to 3e-8 m.
constexpr double kFloatFile = 6e-8;

TEST_F(GltfCup, AMeshPlacedOverAndOverIsRefusedAtOnce) {
  Json gltf = read_json(folder_ / "cup.gltf");
  gltf["nodes"] = Json::array();
  gltf["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 1000; ++i) {
    gltf["nodes"].push_back({{"mesh", 0}});
    gltf["scenes"][0]["nodes"].push_back(i);
  }
  write_json(folder_ / "many.gltf", gltf);
  const auto begin = std::chrono::steady_clock::now();
  expect_error([&] { read(R"({"position_mm": [20, 400], "liquid": "water", "fill_mm": 30})", "many.gltf"); },
               {"/cups/0/shape: many.gltf has triangles of ", "at most 100 times can be searched for its inside"});
  // Searching takes a minute; reading a thousand meshes a fraction of a second.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15));
}

TEST_F(GltfCup, StandsOnTheDeskAndIsFilledFromItsFloor) {
  const Cup cup = read(R"({"position_mm": [20, 400], "liquid": "water", "fill_mm": 30})");
  double lowest = 1.0;
  for (const GltfPart& part : cup_parts(cup))
    for (const Eigen::Vector3d& v : part.mesh.vertices) lowest = std::min(lowest, v.z());
  EXPECT_NEAR(lowest, 0.0, 1e-15);
  EXPECT_NEAR(liquid_level(cup), 0.037, kFloatFile);
  EXPECT_NEAR(cup_depth(cup), 0.080, kFloatFile);
  EXPECT_EQ(cup_name(cup), "cup.gltf");
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const Mesh surface = liquid_surface(cup);
  for (const Eigen::Vector3i& t : surface.triangles) {
    const Eigen::Vector3d &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
    centre += 0.5 * (b - a).cross(c - a).z() * (a + b + c) / 3.0;
  }
  EXPECT_NEAR(centre.x() / centre.z() * 0.037, 0.020, 1e-6);  // rounding of cells at 1e-7 m
  EXPECT_NEAR(centre.y() / centre.z() * 0.037, 0.400, 1e-6);
}

TEST_F(GltfCup, IsFilledToAVolumeAsItsParametricTwin) {
  Cup twin;
  const Json name = "paper_cup";
  twin.shape = cup_shape_from_json(JsonReader(name, "test"));
  const Cup cup = read(R"({"position_mm": [0, 400], "liquid": "water", "fill_ml": 150})");
  // The mesh has 256 facets: its sections are 1e-4 smaller.
  EXPECT_NEAR(cup.filling->depth / depth_of_volume(twin, 150e-6), 1.0, 2e-4);
  EXPECT_NEAR(cup_volume(cup, cup.filling->depth), 150e-6, 1e-11);  // the level is known to 1e-9 m
}

TEST_F(GltfCup, CanBeLiftedTurnedAndTilted) {
  EXPECT_NEAR(liquid_level(read(R"({"position_mm": [0, 400, 10], "liquid": "water", "fill_mm": 30})")), 0.047,
              kFloatFile);
  const Cup tilted =
      read(R"({"position_mm": [0, 400], "rotation_deg": [0, 20, 0], "yaw_deg": 90, "liquid": "water", "fill_mm": 20})");
  const Cavity& cavity = *std::get<MeshCup>(tilted.shape).cavity;
  // Leans towards +x, then a quarter turn: towards +y. The lowest point is the outer bottom's edge.
  const double s = std::sin(radians_from_deg(20.0)), c = std::cos(radians_from_deg(20.0));
  EXPECT_NEAR(cavity.floor(), 0.007 * c - 0.040 * s + 0.043 * s, kFloatFile);
  EXPECT_GT(cavity.spill().y(), 0.45);
}

TEST_F(GltfCup, WhatIsNotInMetresIsRefused) {
  Mesh cup = sheet_of_revolution({{0.0, 0.0}, {0.04, 0.0}, {0.04, 0.1}});
  const auto scaled = [&](double scale) {
    Mesh mesh = cup;
    for (Eigen::Vector3d& v : mesh.vertices) v *= scale;
    write_gltf(folder_ / "scaled.gltf", mesh);
    return [this] { read(R"({"position_mm": [0, 400, 400], "liquid": "water", "fill_ml": 1e-4})", "scaled.gltf"); };
  };
  expect_error(scaled(1000.0), {"/cups/0/shape: scaled.gltf is 100000 mm large, must be from 1 to 2000 mm", "metres"});
  expect_error(scaled(1e-15), {"/cups/0/shape: scaled.gltf is 1e-13 mm large, must be from 1 to 2000 mm"});
  expect_error(scaled(0.0), {"/cups/0/shape: scaled.gltf is 0 mm large"});
  EXPECT_NO_THROW(scaled(0.01)());
}

TEST_F(GltfCup, OfAClearWallHoldsWhatItsOpaqueTwinHolds) {
  const Json name = "paper_cup";
  write_clear_gltf(folder_ / "", cup_mesh(cup_shape_from_json(JsonReader(name, "test"))), 1.5, 0.0);
  const Cup opaque = read(R"({"position_mm": [0, 400], "liquid": "water", "fill_ml": 150})");
  const Cup clear = read(R"({"position_mm": [0, 400], "liquid": "water", "fill_ml": 150})", "body.gltf");
  EXPECT_TRUE(is_clear(clear));
  EXPECT_FALSE(is_clear(opaque));
  EXPECT_NEAR(cup_capacity(clear) / cup_capacity(opaque), 1.0, 1e-5);  // sections are cut at 1e-7 m of 40 mm
  EXPECT_NEAR(liquid_level(clear), liquid_level(opaque), kFloatFile);
  expect_error([&] { read(R"({"position_mm": [0, 400], "liquid": "water", "fill_mm": 81})", "body.gltf"); },
               {"/cups/0/fill_mm: must be at most 80, the depth of the cup (it spills at x "});
  // Filled to the brim, rim and liquid are no one plane.
  const Cup brimful = read(R"({"position_mm": [0, 400], "liquid": "water", "fill_mm": 80})", "body.gltf");
  EXPECT_NEAR(liquid_level(brimful), 0.087 - 1e-5, kFloatFile);
}

TEST_F(GltfCup, OfAClearSheetIsAnsweredInOneLine) {
  const char* filled = R"({"position_mm": [0, 400], "liquid": "water", "fill_mm": 10})";
  Mesh sheet = sheet_of_revolution({{0.0, 0.0}, {0.04, 0.0}, {0.04, 0.1}});
  write_clear_gltf(folder_ / "", sheet, 1.5, 0.0);
  expect_error([&] { read(filled, "body.gltf"); },
               {"scene.json: /cups/0/shape: body.gltf is clear and its wall is open or turned inside out"});
  EXPECT_NO_THROW(read(R"({"position_mm": [0, 400]})", "body.gltf"));
}

TEST_F(GltfCup, WhatCannotBeFilledIsAnsweredInOneLine) {
  write_gltf(folder_ / "plate.gltf", sheet_of_revolution({{0.0, 0.0}, {0.08, 0.0}, {0.08, 0.003}, {0.0, 0.003}}));
  const char* filled = R"({"position_mm": [0, 400], "liquid": "water", "fill_mm": 1})";
  expect_error([&] { read(filled, "plate.gltf"); }, {"scene.json: /cups/0/shape: plate.gltf holds no liquid"});
  expect_error([&] { read(filled, "none.glb"); }, {"none.glb: no such file"});
  EXPECT_NO_THROW(read(R"({"position_mm": [0, 400]})", "plate.gltf"));  // an empty plate is a plate
  expect_error(
      [&] { read(R"({"position_mm": [0, 400], "liquid": "water", "fill_mm": 81})"); },
      {"scene.json: /cups/0/fill_mm: must be at most 80, the depth of the cup (it spills at x ", "z 87.0 mm)"});
  expect_error([&] { read(R"({"position_mm": [0, 400], "liquid": "water", "fill_ml": 500})"); },
               {"scene.json: /cups/0/fill_ml: must be at most 402.0", "what the cup holds (it spills at"});
}

}  // namespace
}  // namespace fathom
