#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/input_policy.h"
#include "core/lengths.h"
#include "core/library.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/medium_json.h"
#include "sim/scene/mesh_memory.h"

namespace fathom {
namespace {

constexpr Range kAlbedo{0.0, 1.0};

Desk desk_from_json(const JsonReader& json) {
  json.allow_only({"albedo", "glaze", "size_mm", "centre_mm"});
  Desk desk;
  desk.albedo = json.number_or("albedo", desk.albedo, kAlbedo);
  desk.glaze = glaze_from_json(json);
  if (json.has("size_mm")) desk.size = json.at("size_mm").vector2(kPlaceMm) * kMetresPerMm;
  if (desk.size.minCoeff() <= 0.0) json.fail_at("size_mm", "must be two lengths above 0");
  if (json.has("centre_mm")) desk.centre = json.at("centre_mm").vector2(kPlaceMm) * kMetresPerMm;
  return desk;
}

Handle handle_from_json(const JsonReader& json) {
  json.allow_only({"low_mm", "high_mm", "reach_mm", "tube_radius_mm"});
  Handle handle;
  handle.low = metres_from_mm(json.number_or("low_mm", mm_from_metres(handle.low), kCupLengthMm));
  handle.high = metres_from_mm(json.number_or("high_mm", mm_from_metres(handle.high), kCupLengthMm));
  handle.reach = metres_from_mm(json.number_or("reach_mm", mm_from_metres(handle.reach), kCupLengthMm));
  handle.tube_radius =
      metres_from_mm(json.number_or("tube_radius_mm", mm_from_metres(handle.tube_radius), kCupLengthMm));
  if (handle.high <= handle.low) json.fail_at("high_mm", "must be above low_mm");
  return handle;
}

CupShape shape_from_object(const JsonReader& json) {
  json.allow_only({"name", "height_mm", "bottom_mm", "inner_radius_mm", "outer_radius_mm", "inner_profile_mm",
                   "outer_profile_mm", "albedo", "material", "handle", "source"});
  CupShape shape;
  shape.name = json.text_or("name", "cup");
  shape.albedo = json.number_or("albedo", shape.albedo, kAlbedo);
  if (json.has("material")) {
    for (const char* key : {"albedo", "handle"})
      if (json.has(key)) json.fail_at(key, "cannot stand beside material: a clear wall has none");
    shape.material = wall_from_json(json.at("material"));
  }
  shape.source = json.text_or("source", "");
  if (json.has("handle")) shape.handle = handle_from_json(json.at("handle"));
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
  const JsonReader glaze = json.at("glaze");
  glaze.allow_only({"roughness", "index"});
  Coat coat{glaze.number("roughness", {kLeastRoughness, 1.0})};
  coat.index = glaze.number_or("index", coat.index, {1.0, 4.0});
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

}  // namespace fathom
