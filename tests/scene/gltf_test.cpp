// Opaque objects from glTF files: axes, transformations, and one line for every way a file can be wrong.
#include "sim/scene/gltf.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/base64.h"
#include "core/files.h"
#include "core/input_policy.h"
#include "core/json.h"
#include "sim/scene/gltf_json.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

/// One triangle (1,2,3) (4,5,6) (7,8,10) with three indices after the positions.
Json triangle(std::array<float, 9> positions = {1, 2, 3, 4, 5, 6, 7, 8, 10},
              std::array<std::uint16_t, 3> indices = {0, 1, 2}) {
  std::string bytes(sizeof(positions) + sizeof(indices), '\0');
  std::memcpy(bytes.data(), positions.data(), sizeof(positions));
  std::memcpy(bytes.data() + sizeof(positions), indices.data(), sizeof(indices));
  Json json = Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]}}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 42}]})");
  json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
  return json;
}

std::vector<GltfPart> read(const Json& json) {
  const TemporaryFolder folder;
  write_text(folder / "thing.gltf", json.dump());
  return read_gltf(folder / "thing.gltf");
}

TEST(Gltf, UpBecomesUp) {
  const std::vector<GltfPart> parts = read(triangle());
  ASSERT_EQ(parts.size(), 1u);
  const Mesh& mesh = parts[0].mesh;
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], Eigen::Vector3d(1, -3, 2));  // (x, −z, y)
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(7, -10, 8));
  EXPECT_EQ(mesh.triangles.at(0), Eigen::Vector3i(0, 1, 2));
  EXPECT_NEAR(parts[0].albedo, 0.5, 1e-15);
}

TEST(Gltf, NodesMoveTurnAndScaleTheirMeshesAndTheirChildren) {
  Json json = triangle();
  json["nodes"] = Json::parse(R"([{"children": [1], "translation": [10, 0, 0]},
      {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0.70710678118654752, 0, 0.70710678118654752]}])");
  // Scaled to (2, 4, 6), a quarter turn about y: (6, 4, −2), moved: (16, 4, −2), z up: (16, 2, 4). Roundings.
  EXPECT_LT((read(json)[0].mesh.vertices[0] - Eigen::Vector3d(16, 2, 4)).norm(), 1e-14);
}

TEST(Gltf, AMeshWithoutIndicesIsReadInOrder) {
  Json json = triangle();
  json["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_EQ(read(json)[0].mesh.triangles.at(0), Eigen::Vector3i(0, 1, 2));
}

TEST(Gltf, ASmoothDielectricHasACoat) {
  EXPECT_FALSE(read(triangle())[0].coat);
  Json json = triangle();
  Json& look = json["materials"][0]["pbrMetallicRoughness"];
  look["roughnessFactor"] = 0.5;
  EXPECT_FALSE(read(json)[0].coat) << "without metallicFactor it is a metal";
  look["metallicFactor"] = 0;
  ASSERT_TRUE(read(json)[0].coat);
  EXPECT_EQ(read(json)[0].coat->roughness, 0.25);
  EXPECT_EQ(read(json)[0].coat->index, 1.5);
  look["roughnessFactor"] = 0.01;
  EXPECT_EQ(read(json)[0].coat->roughness, kLeastRoughness);
  look["roughnessFactor"] = 1;
  EXPECT_FALSE(read(json)[0].coat);
  look["roughnessFactor"] = 2;
  expect_error([&] { read(json); },
               {"/materials/0/pbrMetallicRoughness/roughnessFactor: must be a number from 0 to 1"});
}

Json clear_triangle() {
  Json json = triangle();
  json["materials"][0] = Json::parse(R"({"name": "water", "extensions": {
      "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.33},
      "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 0.5, "attenuationColor": [0.2, 0.2, 0.2]}}})");
  return json;
}

TEST(Gltf, ATransmissiveMaterialIsAClearBody) {
  const std::vector<GltfPart> parts = read(clear_triangle());
  ASSERT_TRUE(parts.at(0).medium);
  EXPECT_EQ(parts[0].medium->name, "water");
  EXPECT_EQ(parts[0].medium->n(830.0), 1.33);
  EXPECT_NEAR(parts[0].medium->absorption, -std::log(0.2) / 0.5, 1e-12);  // a fifth is left after half a metre
  Json json = clear_triangle();
  json["materials"][0]["extras"] =
      Json::parse(R"({"absorption_per_mm": 0.003, "anisotropy": 0.8, "scattering_per_mm": 2})");
  const Medium medium = *read(json).at(0).medium;
  EXPECT_NEAR(medium.absorption, 3.0, 1e-12);
  EXPECT_NEAR(medium.scattering, 2000.0, 1e-9);
  EXPECT_EQ(medium.anisotropy, 0.8);
  json["materials"][0]["extensions"].erase("KHR_materials_ior");
  EXPECT_EQ(read(json).at(0).medium->n(830.0), 1.5);  // glTF's default
  EXPECT_FALSE(read(triangle()).at(0).medium);
}

TEST(Gltf, EachPlacedMeshIsABodyOfItsOwn) {
  Json json = clear_triangle();
  json["nodes"] = Json::parse(R"([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}])");
  const std::vector<GltfPart> parts = read(json);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NE(parts[0].body, parts[1].body);
}

TEST(Gltf, AMirroringNodeKeepsTheOutside) {
  Json json = triangle();
  json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(read(json)[0].mesh.triangles.at(0), Eigen::Vector3i(0, 2, 1));
}

TEST(Gltf, BrokenFilesAreAnsweredInOneLine) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  expect_error([] { read(triangle({1, 2, kNan, 4, 5, 6, 7, 8, 10})); }, {"thing.gltf: ", "is not finite"});
  expect_error([] { read(triangle({1, 2, 3, 4, 5, 6, 7, 8, 9}, {0, 1, 3})); }, {"has the index 3, but only 3"});
  struct Break {
    const char* pointer;
    const char* value;
    const char* message;
  };
  const Break breaks[] = {
      {"/nodes/0/children", "[0]", "/nodes/0: stands in the scene twice"},
      {"/nodes/0/mesh", "7", ""},
      {"/scenes/0/nodes", "[5]", ""},
      {"/scenes/0/nodes", "[]", "has no triangles"},
      {"/scenes/0/nodes", "[0, 0]", "/nodes/0: stands in the scene twice"},
      {"/scene", "3", ""},
      {"/accessors/0/count", "400000000", "past the end of its buffer"},
      {"/accessors/0/byteOffset", "1000", "past the end of its buffer"},
      {"/accessors/0/type", "\"VEC2\"", "of a kind that is not supported"},
      {"/accessors/0/componentType", "5123", "positions that are not floats"},
      {"/accessors/1/componentType", "5126", ""},
      {"/accessors/0/bufferView", "9", ""},
      {"/bufferViews/0/buffer", "9", ""},
      {"/bufferViews/0/byteOffset", "100000", ""},
      {"/buffers/0/byteLength", "100", ""},
      {"/buffers/0/uri", "\"missing.bin\"", ""},
      {"/meshes/0/primitives/0/mode", "1", "no list of triangles"},
      {"/meshes/0/primitives/0/attributes", "{\"NORMAL\": 0}", "has no POSITION"},
      {"/meshes/0/primitives/0/attributes", "{\"POSITION\": 12}", ""},
      {"/meshes/0/primitives/0/material", "4", ""},
      {"/materials/0/extensions", R"({"KHR_materials_transmission": {"transmissionFactor": 2}})", "from 0 to 1"},
      {"/materials/0/extensions",
       R"({"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 0.5}})",
       "from 1 to 4"},
      {"/materials/0/extensions",
       R"({"KHR_materials_transmission": {"transmissionFactor": 1},
           "KHR_materials_volume": {"attenuationDistance": 1, "attenuationColor": [0, 0, 0]}})",
       "attenuationColor: must be 3 numbers"},
  };
  for (const Break& broken : breaks) {
    Json json = triangle();
    json[Json::json_pointer(broken.pointer)] = Json::parse(broken.value);
    SCOPED_TRACE(std::string(broken.pointer) + " = " + broken.value);
    expect_error([&] { read(json); }, {"thing.gltf", broken.message});
  }
}

// Ninety generations of twins that share their children would be 2^90 meshes.
TEST(Gltf, ANodeHasOneParentAndFewAncestors) {
  Json json = triangle();
  const auto generations = [&](int count, int children) {
    json["nodes"] = Json::array();
    for (int i = 1; i < count; ++i) json["nodes"].push_back({{"children", std::vector<int>(children, i)}});
    json["nodes"].push_back({{"mesh", 0}});
    return [&] { return read(json); };
  };
  expect_error(generations(91, 2), {"thing.gltf: /nodes/90: stands in the scene twice"});
  EXPECT_EQ(generations(101, 1)().size(), 1u);
  expect_error(generations(102, 1), {"thing.gltf: /nodes/101: is nested more than 100 deep"});
}

TEST(Gltf, DeepNestingIsAnsweredInOneLine) {
  const TemporaryFolder folder;
  const std::string deep = std::string(20'000, '[') + std::string(20'000, ']');
  Json json = triangle();
  json["nodes"][0]["extras"] = "HERE";
  std::string text = json.dump();
  text.replace(text.find("\"HERE\""), 6, deep);
  write_text(folder / "deep.gltf", text);
  expect_error([&] { read_gltf(folder / "deep.gltf"); }, {"deep.gltf: is nested more than 100 deep"});
  const auto number = [](std::size_t value) {
    std::string bytes(4, '\0');
    for (int i = 0; i < 4; ++i) bytes[static_cast<std::size_t>(i)] = static_cast<char>(value >> (8 * i));
    return bytes;
  };
  text.resize((text.size() + 3) / 4 * 4, ' ');
  write_text(folder / "deep.glb", "glTF" + number(2) + number(20 + text.size()) + number(text.size()) + "JSON" + text);
  expect_error([&] { read_gltf(folder / "deep.glb"); }, {"deep.glb: is nested more than 100 deep"});
}

TEST(Gltf, AMeshPlacedTenThousandTimesIsCountedBeforeItIsMade) {
  Json json = triangle();
  json["nodes"] = Json::array();
  json["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 1000; ++i) {
    json["nodes"].push_back({{"mesh", 0}});
    json["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_EQ(read(json)[0].mesh.triangles.size(), 1000u);
  const InputPolicyScope scope({.most_bytes = 20'000'000});
  EXPECT_NO_THROW(read(json));
  json = triangle();
  json["meshes"][0]["primitives"] = std::vector<Json>(300, json["meshes"][0]["primitives"][0]);
  json["nodes"] = std::vector<Json>(300, Json{{"mesh", 0}});
  for (int i = 0; i < 300; ++i) json["scenes"][0]["nodes"][static_cast<std::size_t>(i)] = i;
  expect_error([&] { read(json); }, {"/meshes/0/primitives/", "promises 20 MB of triangles, at most 20 MB"});
}

TEST(Gltf, WhatCannotBeLeftOutMustBeKnown) {
  Json json = triangle();
  json["extensionsRequired"] = {"KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"};
  EXPECT_NO_THROW(read(json));
  json["extensionsRequired"] = {"KHR_materials_ior", "KHR_draco_mesh_compression"};
  expect_error([&] { read(json); },
               {"thing.gltf: /extensionsRequired: unknown extension 'KHR_draco_mesh_compression', choose from "
                "KHR_materials_ior, KHR_materials_transmission, KHR_materials_volume"});
  json["extensionsRequired"] = {7};
  expect_error([&] { read(json); }, {"/extensionsRequired: unknown extension '7'"});
  json.erase("extensionsRequired");
  json["extensionsUsed"] = {"KHR_texture_transform"};
  EXPECT_NO_THROW(read(json)) << "what may be left out";
}

TEST(Gltf, BuffersLieBesideTheirFile) {
  const TemporaryFolder folder;
  make_directory(folder / "scene");
  Json json = triangle();
  std::string bytes(42, '\0');
  for (std::size_t i = 0; i < 9; ++i) {
    const float coordinate = static_cast<float>(i == 8 ? 10 : i + 1);
    std::memcpy(bytes.data() + 4 * i, &coordinate, 4);
  }
  bytes[38] = 1, bytes[40] = 2;
  write_text(folder / "scene/a b.bin", bytes);
  write_text(folder / "secret.bin", bytes);
  const auto read_with = [&](const std::string& name) {
    json["buffers"][0]["uri"] = name;
    write_text(folder / "scene/thing.gltf", json.dump());
    return read_gltf(folder / "scene/thing.gltf");
  };
  EXPECT_EQ(read_with("a%20b.bin")[0].mesh.vertices[0], Eigen::Vector3d(1, -3, 2));
  const std::string outside = (folder / "secret.bin").string();
  for (const std::string& name : {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), outside}) {
    expect_error([&] { read_with(name); }, {"thing.gltf: /buffers: names '", "--allow-outside"});
    const InputPolicyScope scope({.allow_outside = true});
    EXPECT_NO_THROW(read_with(name));
  }
  expect_error([&] { read_with("none.bin"); }, {"thing.gltf: /buffers: there is no file ", "scene/none.bin"});

  ASSERT_EQ(::mkfifo((folder / "scene/pipe.bin").c_str(), 0600), 0);
  ::alarm(20);  // whoever waits for the pipe's writer ends here
  expect_error([&] { read_with("pipe.bin"); }, {"pipe.bin: is no regular file"});
  ::alarm(0);
}

TEST(Gltf, PositionsAreWithinAKilometre) {
  expect_error(
      [] {
        read(triangle({1, 2, 3, 4, 5, 6, 7, 8, 1e22f}));
      },
      {"/meshes/0/primitives/0: has a position beyond 1000 m; lengths in glTF are metres"});
  Json json = triangle();
  json["nodes"][0]["scale"] = {1e6, 1, 1};
  expect_error([&] { read(json); }, {"has a position beyond 1000 m"});
}

TEST(Gltf, TruncatedAndMissingFilesAreAnsweredInOneLine) {
  const TemporaryFolder folder;
  const std::string whole = triangle().dump();
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, whole.size() / 2, whole.size() - 1}) {
    write_text(folder / "cut.gltf", whole.substr(0, length));
    expect_error([&] { read_gltf(folder / "cut.gltf"); }, {"cut.gltf: is no readable glTF"});
    write_text(folder / "cut.glb", "glTF" + whole.substr(0, length));
    expect_error([&] { read_gltf(folder / "cut.glb"); }, {"cut.glb: is no readable glTF"});
  }
  expect_error([&] { read_gltf(folder / "none.gltf"); }, {"none.gltf: no such file"});
}

TEST(GltfBuffers, AFileThatManyBuffersNameIsNamedOnce) {
  const std::string text = R"({"buffers": [{"uri": "b.bin"}, {"uri": "a.bin"}, {"uri": "b.bin"}, {"uri": "%61.bin"}]})";
  EXPECT_EQ(gltf_buffers("mug.gltf", text), (std::vector<std::string>{"b.bin", "a.bin"}));
}

}  // namespace
}  // namespace fathom
