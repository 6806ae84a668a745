// Scene files: what is written is what stands there, and anything else is refused by name.
#include "sim/scene/scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/library.h"
#include "sim/scene/geometry.h"
#include "sim/scene/medium_json.h"
#include "sim/scene/setup.h"
#include "tests/core/expect_error.h"

namespace fathom {
namespace {

Json good_scene() {
  return Json::parse(R"({
    "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 400, 0]},
    "desk": {"albedo": 0.5, "size_mm": [1000, 800], "centre_mm": [10, 400]},
    "cups": [{"shape": "paper_cup", "position_mm": [20, 400], "yaw_deg": 30, "liquid": "water", "fill_mm": 30}],
    "objects": [{"gltf": "box.glb", "position_mm": [150, 420, 0], "rotation_deg": [0, 0, 30]}]
  })");
}

/// The good scene with the value at `pointer` replaced; a null pointer value removes it.
Setup changed(const char* pointer, const char* value) {
  Json scene = good_scene();
  const Json::json_pointer at(pointer);
  if (value)
    scene[at] = Json::parse(value);
  else
    scene.at(at.parent_pointer()).erase(at.back());
  return setup_from_json(scene, "scene.json");
}

TEST(Scene, IsReadInMetresAndRadians) {
  const auto setup = setup_from_json(good_scene(), "folder/scene.json");
  const Cup& cup = setup.scene.cups.at(0);
  EXPECT_DOUBLE_EQ(cup.position.x(), 0.020);
  EXPECT_DOUBLE_EQ(cup.yaw, 0.52359877559829882);
  EXPECT_DOUBLE_EQ(cup.filling->depth, 0.030);
  EXPECT_DOUBLE_EQ(cup.filling->medium.absorption, 3.1);  // 0.0031 per mm
  EXPECT_DOUBLE_EQ(setup.scene.desk->size.y(), 0.8);
  EXPECT_EQ(std::get<std::filesystem::path>(setup.scene.objects.at(0).thing),
            "folder/box.glb");  // relative to the scene file
  // A quarter turn about z takes x to y.
  const auto turned = changed("/objects/0/rotation_deg", "[0, 0, 90]");
  EXPECT_LT(
      (turned.scene.objects[0].world_from_object.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
      1e-15);
}

TEST(Scene, DeskCanBeLeftOutOnlyByName) {
  EXPECT_TRUE(changed("/desk", nullptr).scene.desk);
  EXPECT_FALSE(changed("/desk", "null").scene.desk);
}

TEST(Scene, AVolumeIsPouredToItsDepth) {
  const auto poured = [](const char* shape, double ml) {
    Json scene = good_scene();
    Json& cup = scene["cups"][0];
    cup.erase("fill_mm");
    cup["fill_ml"] = ml;
    cup["shape"] = shape;
    return setup_from_json(scene, "scene.json").scene.cups[0];
  };
  // π 40² mm² · 30 mm; depths are bisected to a nanometre.
  EXPECT_NEAR(poured("paper_cup", 150.79644737).filling->depth, 0.030, 2e-9);
  // A frustum of radii 26 and 32 mm, half-way up the taper of 86 mm: π/3 · 43 (26² + 26 · 32 + 32²).
  EXPECT_NEAR(
      poured("tapered_cup", std::numbers::pi / 3.0 * 43.0 * (26 * 26 + 26 * 32 + 32 * 32) * 1e-3).filling->depth, 0.043,
      2e-9);
  EXPECT_FALSE(poured("paper_cup", 0.0).filling);
  expect_error([&] { poured("paper_cup", 403.0); }, {"/cups/0/fill_ml: must be at most 402.124, what the cup holds"});
}

TEST(Scene, AnEmptyFillIsAnEmptyCup) { EXPECT_FALSE(changed("/cups/0/fill_mm", "0").scene.cups[0].filling); }

struct Refusal {
  const char* pointer;
  const char* value;  ///< nullptr: the key is removed
  const char* message;
};

TEST(Scene, WhatIsWrongIsNamedWithItsPlaceAndTheChoices) {
  const Refusal refusals[] = {
      {"/table", "{}", "/table: unknown key 'table', choose from $schema, sensor, desk, cups"},
      {"/effects", R"({"name": "ripples"})", "/effects: "},
      {"/sensor", nullptr, "/sensor: is missing"},
      {"/sensor/model", "\"xtion\"",
       "/sensor/model: unknown sensor model 'xtion', choose from kinect_v1, kinect_v1_device, "},
      {"/sensor/height_mm", nullptr, "/sensor/height_mm: is missing"},
      {"/sensor/height_mm", "-1", "/sensor/height_mm: must be a number above 0"},
      {"/sensor/height_mm", "\"650\"", "/sensor/height_mm: must be a number above 0"},
      {"/sensor/height_mm", "1e22", "/sensor/height_mm: must be a number above 0 and at most 1000000, got 1e+22"},
      {"/sensor/baseline_mm", "1e22", "/sensor/baseline_mm: must be a number above 0 and at most 1000000"},
      {"/sensor/aim_mm", "[0, 1e22, 0]", "/sensor/aim_mm/1: must be a number from -1000000 to 1000000"},
      {"/sensor/focal_px", "1e-300", "/sensor/focal_px: must be a number from 1 to 1000000"},
      {"/sensor/pattern", R"({"image": "../dots.png"})", "/sensor/pattern/image: names '../dots.png'"},
      {"/desk/size_mm", "[1e22, 1e22]", "/desk/size_mm/0: must be a number above 0 and at most 1000000"},
      {"/desk/centre_mm", "[1e22, 0]", "/desk/centre_mm/0: must be"},
      {"/objects/0/position_mm", "[0, 0, 1e22]", "/objects/0/position_mm/2: must be"},
      {"/objects/0/gltf", "\"../box.glb\"", "/objects/0/gltf: names '../box.glb', which lies outside"},
      {"/objects/0/gltf", "\"/tmp/box.glb\"", "/objects/0/gltf: names '/tmp/box.glb', which is an absolute path"},
      {"/cups/0/shape", "\"../mug.glb\"", "/cups/0/shape: names '../mug.glb'"},
      {"/sensor/aim_mm", nullptr, "/sensor: needs either aim_mm or pitch_deg"},
      {"/sensor/pitch_deg", "45", "/sensor: needs either aim_mm or pitch_deg"},
      {"/sensor/aim_mm", "[0, 0, 650]", "/sensor/aim_mm: must not be the sensor's own place"},
      {"/sensor/aim_mm", "[0, 400]", "/sensor/aim_mm: "},
      {"/sensor/noise", "\"loud\"", "/sensor/noise: unknown noise preset 'loud', choose from off, basic"},
      {"/sensor/noise", R"({"speckle_shape": 0.5})", "/sensor/noise/speckle_shape: must be 0"},
      {"/sensor/quantization", "\"mm\"", "unknown quantization 'mm', choose from device, off"},
      {"/sensor/ir_size_px", "[1000, 1024]", "/sensor: ir_size_px must be twice depth_size_px"},
      {"/sensor/far_mm", "100", "/sensor/far_mm: must be above near_mm"},
      {"/sensor/matcher", R"({"window_rows": 8})", "/sensor/matcher/window_rows: must be odd"},
      {"/sensor/matcher", R"({"disparity_max_px": -40})", "/sensor/matcher/disparity_max_px: must be above"},
      {"/sensor/pattern", R"({"dots_per_tile": 30000})", "/sensor/pattern/dots_per_tile: must be a whole number"},
      {"/desk/albedo", "1.5", "/desk/albedo: must be a number from 0 to 1"},
      {"/desk/size_mm", "[1000, 0]", "/desk/size_mm/1: must be a number above 0 and at most 1000000, got 0"},
      {"/cups", "{}", "/cups: must be a list"},
      {"/cups/0/shape", "\"glass\"", "/cups/0/shape: unknown cup shape 'glass', choose from mug, paper_cup, tapered"},
      {"/cups/0/position_mm", nullptr, "/cups/0/position_mm: is missing"},
      {"/cups/0/position_mm", "[0, 1e9]", "/cups/0/position_mm/1: must be a number from -100000 to 100000"},
      {"/cups/0/liquid", "\"wtaer\"",
       "/cups/0/liquid: unknown liquid 'wtaer', choose from barley_tea, intralipid_20, milk_tea"},
      {"/cups/0/liquid", nullptr, "/cups/0/fill_mm: needs a liquid"},
      {"/cups/0/liquid", R"({"absorption_per_mm": 1})", "/cups/0/liquid/index: is missing"},
      {"/cups/0/liquid", R"({"index": 0.9})", "/cups/0/liquid/index: must be a number from 1"},
      {"/cups/0/fill_mm", nullptr, "/cups/0/fill_mm: is missing"},
      {"/cups/0/fill_ml", "30", "/cups/0/fill_ml: cannot stand beside fill_mm"},
      {"/cups/0/rotation_deg", "[0, 10, 0]", "/cups/0/rotation_deg: is for cups from glTF files"},
      {"/cups/0/fill_mm", "81", "/cups/0/fill_mm: must be at most 80, the depth of the cup"},
      {"/objects/0/gltf", nullptr, "/objects/0: must have one of gltf and solid"},
  };
  for (const Refusal& refusal : refusals)
    expect_error([&] { changed(refusal.pointer, refusal.value); }, {"scene.json: ", refusal.message});
}

TEST(Scene, ImpossibleShapesAreRefused) {
  const std::pair<const char*, const char*> shapes[] = {
      {R"({"height_mm": 80, "bottom_mm": 80, "inner_radius_mm": 30, "outer_radius_mm": 33})",
       "bottom_mm: must be below"},
      {R"({"height_mm": 80, "bottom_mm": 5, "inner_radius_mm": 33, "outer_radius_mm": 33})",
       "outer_radius_mm: must be"},
      {R"({"height_mm": 80, "inner_profile_mm": [], "outer_profile_mm": []})", "height_mm: cannot stand beside"},
      {R"({"inner_profile_mm": [[0, 4], [26, 4], [38, 90]]})", "outer_profile_mm: is missing"},
      {R"({"inner_profile_mm": [[1, 4], [26, 4], [38, 90]], "outer_profile_mm": []})", "must start on the axis"},
      {R"({"inner_profile_mm": [[0, 4], [26, 3], [38, 90]], "outer_profile_mm": []})", "must not be lower"},
      {R"({"inner_profile_mm": [[0, 4], [26, 4]], "outer_profile_mm": []})", "at least 3 points"},
      {R"({"inner_profile_mm": [[0, 4], [26, 4], [38, 80]], "outer_profile_mm": [[0, 0], [27, 0], [39, 90]]})",
       "inner_profile_mm: must end at the outer rim's height"},
      {R"({"height_mm": 80, "bottom_mm": 5, "inner_radius_mm": 30, "outer_radius_mm": 33,
           "handle": {"low_mm": 50, "high_mm": 40}})",
       "handle/high_mm: must be above low_mm"},
      // Of 10^8 m no level could be bisected to a nanometre.
      {R"({"height_mm": 1e11, "bottom_mm": 5, "inner_radius_mm": 30, "outer_radius_mm": 33})",
       "height_mm: must be a number above 0 and at most 2000"},
      {R"({"inner_profile_mm": [[0, 4], [-1, 4], [38, 90]], "outer_profile_mm": []})",
       "inner_profile_mm/1/0: must be a number from 0 to 2000"},
  };
  for (const auto& [shape, message] : shapes)
    expect_error([shape = shape] { changed("/cups/0/shape", shape); }, {"scene.json: /cups/0/shape", message});
}

TEST(Scene, GltfScenesAreRefusedInWords) {
  expect_error([] { read_setup("room.glb"); }, {"room.glb: glTF scenes cannot be read yet"});
}

TEST(Library, EveryEntryLoadsAndNamesItsSource) {
  const auto as_json = [](const std::string& name) { return Json(name); };
  for (const std::string& name : library_names("cups")) {
    const Json json = as_json(name);
    const CupShape shape = cup_shape_from_json(JsonReader(json, "test"));
    EXPECT_EQ(shape.name, name);
    EXPECT_FALSE(shape.source.empty()) << name;
  }
  for (const std::string& name : library_names("media")) {
    const Json json = as_json(name);
    const Medium medium = medium_from_json(JsonReader(json, "test"));
    EXPECT_FALSE(medium.source.empty()) << name;
    EXPECT_GT(medium.n(830.0), 1.32) << name;  // drinks are water and more
    EXPECT_LT(medium.n(830.0), 1.37) << name;
  }
  for (const std::string& name : library_names("walls")) {
    const Json json = as_json(name);
    const Medium medium = wall_from_json(JsonReader(json, "test"));
    EXPECT_FALSE(medium.source.empty()) << name;
    EXPECT_GT(medium.n(830.0), 1.45) << name;  // glasses and plastics
    EXPECT_LT(medium.n(830.0), 1.60) << name;
  }
  for (const std::string& name : library_names("sensors"))
    EXPECT_EQ(changed("/sensor/model", as_json(name).dump().c_str()).rig.sensor.name, name);
}

TEST(LiquidForm, MustStayBetweenBottomAndRim) {
  const auto with = [](const char* surface) { return [=] { changed("/cups/0/surface", surface); }; };
  expect_error(with(R"({"tilt_deg": 44, "contact_angle_deg": 90, "capillary_length_mm": 2})"), {"/cups/0/surface: l"});
  expect_error(with(R"({"ripples": [{"wavelength_mm": 5, "amplitude_mm": 90}]})"), {"/cups/0/surface: lifts", "rim"});
  expect_error(with(R"({"contact_angle_deg": 30})"), {"/cups/0/surface/capillary_length_mm: is missing"});
  expect_error(with(R"({"contact_angle_deg": 0, "capillary_length_mm": 2.73})"),
               {"contact_angle_deg: must be a number"});
  expect_error(with(R"({"tilt_deg": -1})"), {"/cups/0/surface/tilt_deg: must be a number from 0"});
  expect_error([] { changed("/cups/0", R"({"shape": "paper_cup", "position_mm": [0, 400], "surface": {}})"); },
               {"/cups/0/surface: needs a liquid"});
}

TEST(ClearWall, HasNoAlbedoAndNoHandle) {
  const auto with = [](const char* more) {
    return [=] {
      changed("/cups/0/shape", (R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43, )" +
                                std::string(more) + "}")
                                   .c_str());
    };
  };
  with(R"("material": "soda_lime")")();
  expect_error(with(R"("material": "pmma", "albedo": 0.5)"), {"/cups/0/shape/albedo: cannot stand beside material"});
  expect_error(with(R"("material": "pmma", "handle": {})"), {"/cups/0/shape/handle: cannot stand beside material"});
  expect_error(with(R"("material": "glass")"), {"unknown wall material 'glass'", "soda_lime"});
}

TEST(Glaze, IsForOpaqueCupsOfRevolutionAndNotTooSmooth) {
  const auto with = [](const char* shape, const char* glaze) {
    return [=] {
      changed("/cups/0", fmt::format(R"({{"shape": {}, "position_mm": [0, 400], "glaze": {}}})", shape, glaze).c_str());
    };
  };
  with(R"("mug")", R"({"roughness": 0.1})")();
  expect_error(with(R"("mug")", "{}"), {"/cups/0/glaze/roughness"});
  expect_error(with(R"("mug")", R"({"roughness": 0.01})"),
               {"/cups/0/glaze/roughness: must be a number from 0.02 to 1"});
  expect_error(with(R"("mug")", R"({"roughness": 0.1, "index": 0.9})"),
               {"/cups/0/glaze/index: must be a number from 1"});
  expect_error(with(R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43,
                        "material": "soda_lime"})",
                    R"({"roughness": 0.1})"),
               {"/cups/0/glaze: is for opaque walls"});
}

TEST(Geometry, AGlazeKnowsEveryMediumThatMayBeOverIt) {
  auto setup = changed("/objects", "[]");
  std::get<CupShape>(setup.scene.cups[0].shape).glaze = Coat{0.1, 1.5};
  const Geometry geometry = build_geometry(setup.scene, 830.0);
  ASSERT_EQ(geometry.bodies.size(), 1u);
  int glazed_surfaces = 0;
  for (const Surface& surface : geometry.surfaces)
    if (const auto* glazed = std::get_if<Glazed>(&surface.optics)) {
      ++glazed_surfaces;
      ASSERT_EQ(glazed->under.size(), 2u);
      // The nearer the indices, the less the surface reflects: Fresnel's 4 % at normal incidence in air, 0.4 % in
      // water.
      EXPECT_NEAR(glazed->under[0].surface_reflectance(1.0), 0.04, 0.001);
      EXPECT_NEAR(glazed->under[1].surface_reflectance(1.0), 0.0037, 0.0003);
    }
  EXPECT_GT(glazed_surfaces, 2);
}

TEST(Geometry, WallsWinOverGltfBodiesOverLiquids) {
  auto setup = changed("/objects", "[]");
  std::get<CupShape>(setup.scene.cups[0].shape).material =
      Medium{.name = "glass", .index = ConstantIndex{1.2}, .source = ""};
  const Geometry geometry = build_geometry(setup.scene, 830.0);
  ASSERT_EQ(geometry.bodies.size(), 2u);
  EXPECT_GT(geometry.bodies[0].medium.n, 1.3);  // the liquid, though the denser
  EXPECT_EQ(geometry.bodies[1].medium.n, 1.2);
  EXPECT_FALSE(geometry.bodies[0].plain);
}

TEST(Geometry, WallsMayScatter) {
  auto setup = changed("/cups/0/shape", R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40,
      "outer_radius_mm": 43, "material": {"index": 1.5, "scattering_per_mm": 1}})");
  setup.scene.objects.clear();
  const Geometry geometry = build_geometry(setup.scene, 830.0);
  EXPECT_TRUE(geometry.bodies.back().scatters());
  EXPECT_GT(geometry.bodies.back().surface_albedo, 0.0);
  EXPECT_FALSE(geometry.bodies.front().plain);
}

TEST(Geometry, TurbidLiquidsSayWhatIsLeftOut) {
  auto setup = changed("/objects", "[]");
  EXPECT_TRUE(build_geometry(setup.scene, 830.0).approximations.empty());
  setup = changed("/cups/0/liquid", "\"milk_tea\"");
  setup.scene.objects.clear();
  const Geometry geometry = build_geometry(setup.scene, 830.0);
  EXPECT_TRUE(geometry.bodies.back().scatters());
  EXPECT_EQ(geometry.approximations.size(), 1u);
  EXPECT_EQ(geometry.objects, (std::vector<std::string>{"desk", "cup 0 paper_cup", "cup 0 milk_tea"}));
}

}  // namespace
}  // namespace fathom
