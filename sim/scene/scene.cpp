#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fields.h"
#include "core/input_policy.h"
#include "core/library.h"
#include "core/range.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/medium_json.h"
#include "sim/scene/mesh.h"
#include "sim/scene/rig.h"

namespace fathom {
namespace {

constexpr Range kAlbedo{0.0, 1.0};

std::span<const Field<Coat>> glaze_fields() {
  static const Field<Coat> fields[] = {
      {"roughness", &Coat::roughness, {kLeastRoughness, 1.0}, "α of the slopes of its facets (GGX)", true},
      {"index", &Coat::index, {1.0, 4.0}, "refractive index"}};
  return fields;
}

std::span<const Field<Desk>> desk_fields() {
  static const Field<Desk> fields[] = {
      {"albedo", &Desk::albedo, kAlbedo, "share of the light that it scatters back"},
      {"glaze", unread<Desk>("#/$defs/glaze", "an object"), "a clear coat, which mirrors"},
      {"size_mm", Lengths{&Desk::size}, kLengthMm, "along x and y"},
      {"centre_mm", Lengths{&Desk::centre}, kPlaceMm, "its middle"}};
  return fields;
}

std::span<const Field<Handle>> handle_fields() {
  static const Field<Handle> fields[] = {
      {"low_mm", Length{&Handle::low}, kCupLengthMm, "height where it leaves the wall"},
      {"high_mm", Length{&Handle::high}, kCupLengthMm, "height where it joins the wall again"},
      {"reach_mm", Length{&Handle::reach}, kCupLengthMm, "how far its centre line stands out of the wall"},
      {"tube_radius_mm", Length{&Handle::tube_radius}, kCupLengthMm, "radius of its section"}};
  return fields;
}

Handle handle_from_json(const JsonReader& json) {
  Handle handle;
  read_fields(json, handle_fields(), handle);
  if (handle.high <= handle.low) json.fail_at("high_mm", "must be above low_mm");
  return handle;
}

std::span<const Field<CupShape>> shape_fields() {
  using Shape = CupShape;
  constexpr std::string_view kPoints = "points [radius, height]";
  static const Field<Shape> fields[] = {
      {"name", &Shape::name, "what the cup is called"},
      {"height_mm", Part<Shape>{}, kCupLengthMm, "of the rim; four lengths describe upright walls on a flat bottom"},
      {"bottom_mm", Part<Shape>{}, kCupLengthMm, "of the inside, above the desk"},
      {"inner_radius_mm", Part<Shape>{}, kCupLengthMm, "of the inside"},
      {"outer_radius_mm", Part<Shape>{}, kCupLengthMm, "of the outside"},
      {"inner_profile_mm", unread<Shape>("#/$defs/profile", kPoints),
       "instead of lengths: the inside from the axis to the rim, heights above the desk"},
      {"outer_profile_mm", unread<Shape>("#/$defs/profile", kPoints), "the same of the outside"},
      {"albedo", &Shape::albedo, kAlbedo, "of an opaque wall"},
      {"material",
       Part<Shape>{[](const JsonReader& json, Shape& shape) { shape.material = wall_from_json(json); }, nullptr,
                   R"({"anyOf": [{"type": "string"}, {"$ref": "#/$defs/liquid"}]})", "a name or an object"},
       "of a wall that light enters, such as glass, or plastic that scatters: a name of `fathom list walls` or a "
       "description; without it the wall is opaque"},
      {"handle",
       Part<Shape>{[](const JsonReader& json, Shape& shape) { shape.handle = handle_from_json(json); }, nullptr,
                   "#/$defs/handle", "an object"},
       "of an opaque cup"},
      {"source", &Shape::source, "where the numbers come from"}};
  return fields;
}

CupShape shape_from_object(const JsonReader& json) {
  CupShape shape;
  shape.name = "cup";
  read_fields(json, shape_fields(), shape);
  if (shape.material)
    for (const char* key : {"albedo", "handle"})
      if (json.has(key)) json.fail_at(key, "cannot stand beside material: a clear wall has none");
  static_cast<CupProfile&>(shape) = cup_profile_from_json(json);
  return shape;
}

}  // namespace

double CupShape::volume(double depth) const {
  const double level = bottom() + depth;
  double volume = 0.0;
  for (std::size_t i = 1; i < inner.size() && inner[i - 1].y() < level; ++i) {
    const double low = inner[i - 1].x(), high = inner[i].y() > level ? inner_radius(level) : inner[i].x();
    const double height = std::min(inner[i].y(), level) - inner[i - 1].y();
    volume += std::numbers::pi / 3.0 * height * (low * low + low * high + high * high);  // a frustum
  }
  return volume;
}

bool names_gltf(const std::string& file) { return file.ends_with(".gltf") || file.ends_with(".glb"); }

Eigen::Quaterniond rotation_from_json(const JsonReader& json) {
  if (!json.has("rotation_deg")) return Eigen::Quaterniond::Identity();
  const Eigen::Vector3d angles = json.at("rotation_deg").vector3();
  return Eigen::AngleAxisd(radians_from_deg(angles.z()), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(radians_from_deg(angles.y()), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(radians_from_deg(angles.x()), Eigen::Vector3d::UnitX());
}

double CupShape::wall_lean(double height_above_desk) const {
  constexpr double kSpan = 0.5e-3;
  return std::atan((inner_radius(height_above_desk + kSpan) - inner_radius(height_above_desk - kSpan)) / (2.0 * kSpan));
}

Desk desk_from_json(const JsonReader& json) {
  Desk desk;
  read_fields(json, desk_fields(), desk);
  desk.glaze = glaze_from_json(json);
  return desk;
}

CupShape cup_shape_from_json(const JsonReader& json) {
  if (!json.value().is_string()) return shape_from_object(json);
  const std::string name = json.text();
  if (names_gltf(name)) json.fail("must be a body of revolution: a name of scenes/cups or a profile, no glTF file");
  const std::filesystem::path file = library_file("cups", "cup shape", name, json.file(), json.pointer());
  const Json text = read_json(file);
  CupShape shape = shape_from_object(JsonReader(text, file.string()));
  shape.name = name;
  return shape;
}

std::optional<Coat> glaze_from_json(const JsonReader& json) {
  if (!json.has("glaze")) return std::nullopt;
  Coat coat{};
  read_fields(json.at("glaze"), glaze_fields(), coat);
  return coat;
}

Eigen::Translation3d put_down(const JsonReader& json, double lowest) {
  const JsonReader position = json.at("position_mm");
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  if (position.value().is_array() && position.value().size() == 3)
    place = position.vector3(kCupPlaceMm) * kMetresPerMm;
  else
    place.head<2>() = position.vector2(kCupPlaceMm) * kMetresPerMm;
  return Eigen::Translation3d(place - lowest * Eigen::Vector3d::UnitZ());
}

Scene scene_from_json(const JsonReader& json) {
  Scene scene;
  if (json.has("desk")) {
    if (json.value()["desk"].is_null())
      scene.desk.reset();
    else
      scene.desk = desk_from_json(json.at("desk"));
  }
  std::uint64_t claimed = 0;
  for (const JsonReader& cup : json.items_or_none("cups")) {
    scene.cups.push_back(cup_from_json(cup));
    if (const auto* mesh = std::get_if<MeshCup>(&scene.cups.back().shape))
      for (const GltfPart& part : mesh->parts)
        claimed += traced_bytes(part.mesh.vertices.size(), part.mesh.triangles.size());
    require_within_limit(cup.file(), cup.pointer(), claimed, "triangles");
  }
  for (const JsonReader& object : json.items_or_none("objects")) scene.objects.push_back(object_from_json(object));
  return scene;
}

std::vector<KeyTable> scene_key_tables() {
  std::vector<KeyTable> tables = sensor_key_tables();
  tables.push_back({"desk", "desk", "Desk", key_rows(desk_fields(), Desk{})});
  for (KeyTable& table : cup_key_tables()) tables.push_back(std::move(table));
  tables.push_back({"cups[].shape", "shape", "Shape of a cup of revolution", key_rows(shape_fields(), CupShape{})});
  tables.push_back({"cups[].shape.handle", "handle", "Handle", key_rows(handle_fields(), Handle{})});
  tables.push_back({"desk.glaze, cups[].glaze", "glaze", "Glaze", key_rows(glaze_fields(), Coat{})});
  for (std::vector<KeyTable> (*const more)() : {medium_key_tables, object_key_tables})
    for (KeyTable& table : more()) tables.push_back(std::move(table));
  return tables;
}

}  // namespace fathom
