// Reading of a scene's objects.
#include <fmt/format.h>

#include <limits>

#include "core/input_policy.h"
#include "core/lengths.h"
#include "core/library.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/object.h"

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

Solid solid_from_object(const JsonReader& json) {
  json.allow_only({"name", "box_mm", "profile_mm", "cup", "albedo", "source"});
  if (json.has("box_mm") + json.has("profile_mm") + json.has("cup") != 1)
    json.fail("must have one of box_mm, profile_mm and cup");
  Solid solid;
  if (json.has("box_mm")) {
    solid.name = "box";
    solid.form = Box{json.at("box_mm").vector3({0.0, kCupLengthMm.high, true}) * kMetresPerMm};
  } else if (json.has("profile_mm")) {
    solid.name = "solid";
    solid.form = revolved_from_json(json.at("profile_mm"));
  } else {
    const CupShape shape = opaque_shape(json.at("cup"));
    solid.name = shape.name;
    solid.albedo = shape.albedo;
    solid.form = shape;
  }
  solid.name = json.text_or("name", solid.name);
  solid.albedo = json.number_or("albedo", solid.albedo, {0.0, 1.0});
  return solid;
}

}  // namespace

Solid solid_from_json(const JsonReader& json) {
  if (!json.value().is_string()) return solid_from_object(json);
  const std::filesystem::path file = library_file("solids", "solid", json.text(), json.file(), json.pointer());
  const Json entry = read_json(file);
  Solid solid = solid_from_object(JsonReader(entry, file.string()));
  solid.name = json.text();
  return solid;
}

Object object_from_json(const JsonReader& json) {
  json.allow_only({"gltf", "solid", "position_mm", "rotation_deg"});
  if (json.has("gltf") == json.has("solid")) json.fail("must have one of gltf and solid");
  Object object;
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

}  // namespace fathom
