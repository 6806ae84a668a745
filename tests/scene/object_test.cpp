// Solids on the desk: they are closed, stand where they are put, and say what is wrong with their description.
#include "core/json.h"
#include "sim/scene/scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/files.h"
#include "core/library.h"
#include "core/units.h"
#include "sim/scene/mesh_topology.h"
#include "tests/core/expect_error.h"

namespace fathom {
namespace object_test {

Object object(const char* text) {
  const Json json = Json::parse(text);
  return object_from_json(JsonReader(json, "scene.json", "/objects/0"));
}

Mesh mesh_of(const char* text) { return object_parts(object(text)).at(0).mesh; }

Eigen::AlignedBox3d box_around(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

/// By the divergence theorem; positive when the triangles face out of a closed mesh.
double volume(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const Eigen::Vector3i& corner : mesh.triangles)
    six_volumes += mesh.vertices[corner[0]].dot(mesh.vertices[corner[1]].cross(mesh.vertices[corner[2]]));
  return six_volumes / 6.0;
}

constexpr double kRounding = 1e-12;  // [m] of sums of a few lengths below a metre

TEST(Object, ABoxIsAsLargeAsItSaysAndStandsOnTheDesk) {
  const Mesh mesh = mesh_of(R"({"solid": {"box_mm": [100, 60, 30]}, "position_mm": [200, 400]})");
  EXPECT_NEAR(volume(mesh), 0.1 * 0.06 * 0.03, kRounding);
  EXPECT_LT((box_around(mesh).min() - Eigen::Vector3d(0.15, 0.37, 0.0)).norm(), kRounding);
  EXPECT_LT((box_around(mesh).max() - Eigen::Vector3d(0.25, 0.43, 0.03)).norm(), kRounding);
}

TEST(Object, ATurnedSolidLiesOnTheDeskOrAtTheHeightThatIsAskedFor) {
  // A box on its edge is as high as its diagonal.
  const Mesh on_edge =
      mesh_of(R"({"solid": {"box_mm": [100, 60, 60]}, "position_mm": [0, 400], "rotation_deg": [45, 0, 0]})");
  EXPECT_NEAR(box_around(on_edge).min().z(), 0.0, kRounding);
  EXPECT_NEAR(box_around(on_edge).max().z(), 0.06 * std::numbers::sqrt2, kRounding);
  const Mesh inverted =
      mesh_of(R"({"solid": {"cup": "paper_cup"}, "position_mm": [0, 400, 20], "rotation_deg": [180, 0, 0]})");
  EXPECT_NEAR(box_around(inverted).min().z(), 0.020, kRounding);
  EXPECT_NEAR(box_around(inverted).max().z(), 0.107, kRounding);
}

TEST(Object, ARevolvedProfileHasTheVolumeItSweeps) {
  // A cone frustum with a cone's hollow from above: π h (R² + R r + r²) / 3 less π h r² / 3, with 256 facets around.
  const Mesh mesh =
      mesh_of(R"({"solid": {"profile_mm": [[0, 0], [40, 0], [30, 50], [0, 20]]}, "position_mm": [0, 0]})");
  const double facets = 256.0 / (2.0 * std::numbers::pi) * std::sin(2.0 * std::numbers::pi / 256.0);
  const double swept = std::numbers::pi * (0.05 * (0.04 * 0.04 + 0.04 * 0.03 + 0.03 * 0.03) - 0.03 * 0.03 * 0.03) / 3.0;
  EXPECT_NEAR(volume(mesh), facets * swept, 1e-9 * swept);
}

TEST(Object, EverySolidOfTheLibraryIsClosedAndCitesItsSource) {
  for (const std::string& name : library_names("solids")) {
    const Json json = {{"solid", name}, {"position_mm", {0, 400}}};
    const Object solid = object_from_json(JsonReader(json, "scene.json"));
    EXPECT_TRUE(encloses_volume(object_parts(solid).at(0).mesh)) << name;
    EXPECT_EQ(object_name(solid), name);
    EXPECT_TRUE(read_json(data_directory() / "solids" / (name + ".json")).contains("source")) << name;
  }
}

TEST(Object, WrongSolidsSayWhatIsWrong) {
  const std::pair<const char*, const char*> refusals[] = {
      {R"({"position_mm": [0, 0]})", "/objects/0: must have one of gltf and solid"},
      {R"({"gltf": "a.glb", "solid": "can", "position_mm": [0, 0]})", "/objects/0: must have one of gltf and solid"},
      {R"({"solid": "can"})", "/objects/0/position_mm: is missing"},
      {R"({"solid": "cann", "position_mm": [0, 0]})", "/objects/0/solid: unknown solid 'cann', choose from book, "},
      {R"({"solid": {}, "position_mm": [0, 0]})", "/objects/0/solid: must have one of box_mm, profile_mm and cup"},
      {R"({"solid": {"box_mm": [1, 0, 1]}, "position_mm": [0, 0]})", "/objects/0/solid/box_mm/1: must be a number"},
      {R"({"solid": {"profile_mm": [[0, 0], [1, 1]]}, "position_mm": [0, 0]})", "must hold at least 3 points"},
      {R"({"solid": {"profile_mm": [[0, 0], [9, 0], [9, 9]]}, "position_mm": [0, 0]})",
       "must begin and end on the axis"},
      {R"({"solid": {"profile_mm": [[0, 9], [9, 9], [0, 0]]}, "position_mm": [0, 0]})", "must go round a body"},
      {R"({"solid": {"cup": {"height_mm": 80, "bottom_mm": 5, "inner_radius_mm": 30, "outer_radius_mm": 33,
          "material": {"index": 1.5}}}, "position_mm": [0, 0]})",
       "/objects/0/solid/cup: must be an opaque cup"},
  };
  for (const auto& [text, message] : refusals)
    expect_error([&, text = text] { object(text); }, {"scene.json: ", message});
}

}  // namespace object_test
}  // namespace fathom
