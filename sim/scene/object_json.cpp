// Reading of a scene's objects.
#include <fmt/format.h>

#include <limits>

#include "core/fields.h"
#include "core/input_policy.h"
#include "core/library.h"
#include "core/range.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/scene.h"

namespace fathom {
namespace {

Revolved revolved_from_json(const JsonReader& json) {
  Revolved revolved;
  for (const JsonReader& point : json.items())
    revolved.profile.push_back(point.vector2({0.0, kCupLengthMm.high}) * kMetresPerMm);
  const std::vector<Eigen::Vector2d>& profile = revolved.profile;
  if (profile.size() < 3) json.fail("must hold at least 3 points");
  if (profile.size() > kMostProfilePoints) json.fail(fmt::format("must hold at most {} points", kMostProfilePoints));
  if (profile.front().x() != 0.0 || profile.back().x() != 0.0) json.fail("must begin and end on the axis (radius 0)");
  double twice_area = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i)
    twice_area += profile[i - 1].x() * profile[i].y() - profile[i].x() * profile[i - 1].y();
  if (twice_area <= 0.0) json.fail("must go round a body, up its outside and back to the axis");
  return revolved;
}

CupShape opaque_shape(const JsonReader& json) {
  CupShape shape = cup_shape_from_json(json);
  if (shape.material) json.fail("must be an opaque cup; a clear one stands under \"cups\"");
  return shape;
}

std::span<const Field<Solid>> solid_fields() {
  static const Field<Solid> fields[] = {
      {"name", &Solid::name, "what it is called"},
      {"box_mm",
       unread<Solid>(R"({"type": "array", "items": {"$ref": "#/$defs/cup_length"}, "minItems": 3, "maxItems": 3})",
                     "[x, y, z]"),
       "a box by its sides; the middle of its base is the origin"},
      {"profile_mm", unread<Solid>("#/$defs/profile", "points [radius, height]"),
       "a body of revolution: from the axis round the outside and back to the axis above"},
      {"cup", unread<Solid>(R"({"anyOf": [{"type": "string"}, {"$ref": "#/$defs/shape"}]})", "a name or an object"),
       "a cup's shape, empty and opaque, to be turned over or laid down"},
      {"albedo", &Solid::albedo, {0.0, 1.0}, "share of the light that it scatters back"},
      {"source", unread<Solid>(R"({"type": "string"})", "a text"), "where the numbers come from"}};
  return fields;
}

std::span<const Field<Object>> object_fields() {
  static const Field<Object> fields[] = {
      {"gltf", unread<Object>(R"({"type": "string"})", "a path"), "a glTF file, relative to this file; or `solid`"},
      {"solid", unread<Object>(R"({"anyOf": [{"type": "string"}, {"$ref": "#/$defs/solid"}]})", "a name or an object"),
       "a name of `fathom list solids`, or one of `box_mm`, `profile_mm` and `cup`"},
      {"position_mm",
       unread<Object>(R"({"type": "array", "items": {"$ref": "#/$defs/place"}, "minItems": 2, "maxItems": 3})",
                      "[x, y] or [x, y, z]"),
       "of the glTF file's origin, three numbers; a solid stands there on the desk, or with its lowest point at z"},
      {"rotation_deg", unread<Object>("#/$defs/vector3", "[x, y, z]"), "about the fixed axes x, then y, then z"}};
  return fields;
}

Solid solid_from_object(const JsonReader& json) {
  Solid solid;
  read_fields(json, solid_fields(), solid);
  if (json.has("box_mm") + json.has("profile_mm") + json.has("cup") != 1)
    json.fail("must have one of box_mm, profile_mm and cup");
  std::string name = "solid";
  if (json.has("box_mm")) {
    name = "box";
    solid.form = Box{json.at("box_mm").vector3(kCupLengthMm) * kMetresPerMm};
  } else if (json.has("profile_mm")) {
    solid.form = revolved_from_json(json.at("profile_mm"));
  } else {
    const CupShape shape = opaque_shape(json.at("cup"));
    name = shape.name;
    if (!json.has("albedo")) solid.albedo = shape.albedo;
    solid.form = shape;
  }
  if (!json.has("name")) solid.name = name;
  return solid;
}

Solid solid_from_json(const JsonReader& json) {
  if (!json.value().is_string()) return solid_from_object(json);
  const std::filesystem::path file = library_file("solids", "solid", json.text(), json.file(), json.pointer());
  const Json entry = read_json(file);
  Solid solid = solid_from_object(JsonReader(entry, file.string()));
  solid.name = json.text();
  return solid;
}

}  // namespace

Object object_from_json(const JsonReader& json) {
  Object object;
  read_fields(json, object_fields(), object);
  if (json.has("gltf") == json.has("solid")) json.fail("must have one of gltf and solid");
  object.world_from_object = rotation_from_json(json);
  if (json.has("gltf")) {
    object.thing = path_named_in(json.file(), json.pointer() + "/gltf", json.text("gltf"));
    if (json.has("position_mm"))
      object.world_from_object =
          Eigen::Translation3d(json.at("position_mm").vector3(kPlaceMm) * kMetresPerMm) * object.world_from_object;
    return object;
  }
  object.thing = solid_from_json(json.at("solid"));
  double lowest = std::numeric_limits<double>::infinity();
  for (const GltfPart& part : object_parts(object))
    for (const Eigen::Vector3d& vertex : part.mesh.vertices) lowest = std::min(lowest, vertex.z());
  object.world_from_object = put_down(json, lowest) * object.world_from_object;
  return object;
}

std::vector<KeyTable> object_key_tables() {
  return {{"objects[]", "object", "Object", key_rows(object_fields(), Object{})},
          {"objects[].solid", "solid", "Solid", key_rows(solid_fields(), Solid{})}};
}

}  // namespace fathom
