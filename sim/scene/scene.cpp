#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/input_policy.h"
#include "core/lengths.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/library.h"
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

std::vector<Eigen::Vector2d> profile_from_json(const JsonReader& json) {
  std::vector<Eigen::Vector2d> profile;
  for (const JsonReader& item : json.items()) {
    profile.push_back(item.vector2({0.0, kCupLengthMm.high}) * kMetresPerMm);
    if (profile.size() > 1 && profile.back().y() < profile[profile.size() - 2].y())
      item.fail("must not be lower than the point before it");
  }
  if (profile.size() < 3) json.fail("must hold at least 3 points, from the axis to the rim");
  if (profile.size() > kMostProfilePoints) json.fail(fmt::format("must hold at most {} points", kMostProfilePoints));
  if (profile.front().x() != 0.0) json.fail("must start on the axis (radius 0)");
  return profile;
}

/// Radius of a profile at a height, by linear interpolation.
double radius_at(const std::vector<Eigen::Vector2d>& profile, double height) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d &below = profile[i - 1], &above = profile[i];
    if (height > above.y() || above.y() == below.y()) continue;
    const double t = (height - below.y()) / (above.y() - below.y());
    return below.x() + std::clamp(t, 0.0, 1.0) * (above.x() - below.x());
  }
  return profile.back().x();
}

/// Straight walls: the paper's cup and every "height, radii, bottom" description.
void set_cylinder(const JsonReader& json, CupShape& shape) {
  const double height = metres_from_mm(json.number("height_mm", kCupLengthMm));
  const double bottom = metres_from_mm(json.number("bottom_mm", kCupLengthMm));
  const double inner = metres_from_mm(json.number("inner_radius_mm", kCupLengthMm));
  const double outer = metres_from_mm(json.number("outer_radius_mm", kCupLengthMm));
  if (bottom >= height) json.fail_at("bottom_mm", "must be below height_mm");
  if (outer <= inner) json.fail_at("outer_radius_mm", "must be above inner_radius_mm");
  shape.inner = {{0.0, bottom}, {inner, bottom}, {inner, height}};
  shape.outer = {{0.0, 0.0}, {outer, 0.0}, {outer, height}};
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
  if (!json.has("inner_profile_mm") && !json.has("outer_profile_mm")) {
    set_cylinder(json, shape);
    return shape;
  }
  for (const char* key : {"height_mm", "bottom_mm", "inner_radius_mm", "outer_radius_mm"})
    if (json.has(key)) json.fail_at(key, "cannot stand beside a profile, which already says it");
  shape.inner = profile_from_json(json.at("inner_profile_mm"));
  shape.outer = profile_from_json(json.at("outer_profile_mm"));
  if (shape.outer.front().y() != 0.0) json.fail_at("outer_profile_mm", "must start at height 0, on the desk");
  if (shape.inner.back().y() != shape.outer.back().y())
    json.fail_at("inner_profile_mm", "must end at the outer rim's height");
  if (shape.bottom() <= 0.0) json.fail_at("inner_profile_mm", "must start above the desk, at the bottom's thickness");
  for (const auto* profile : {&shape.inner, &shape.outer})
    for (const Eigen::Vector2d& point : *profile)
      if (point.y() >= shape.bottom() && shape.inner_radius(point.y()) >= shape.outer_radius(point.y()))
        json.fail_at("inner_profile_mm",
                     fmt::format("must stay inside outer_profile_mm, but meets it {:g} mm above the desk",
                                 mm_from_metres(point.y())));
  if (shape.inner.back().x() >= shape.outer.back().x())
    json.fail_at("inner_profile_mm", "must end inside the outer rim");
  return shape;
}

}  // namespace

double CupShape::inner_radius(double height_above_desk) const { return radius_at(inner, height_above_desk); }
double CupShape::outer_radius(double height_above_desk) const { return radius_at(outer, height_above_desk); }

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
