// Reading of a scene's cups, and of what is poured into them.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/fields.h"
#include "core/input_policy.h"
#include "core/range.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/liquid_top.h"
#include "sim/scene/medium_json.h"
#include "sim/scene/mesh_topology.h"

namespace fathom {
namespace {

/// Reads and places a glTF cup: turned, then put down with its lowest point on the desk, or at the height that a third
/// number of the position gives.
MeshCup mesh_cup_from_json(const JsonReader& json, double yaw) {
  const JsonReader shape = json.at("shape");
  const std::filesystem::path file = path_named_in(shape.file(), shape.pointer(), shape.text());
  MeshCup cup{file.filename().string(), read_gltf(file), Pose::Identity(), nullptr};
  const Pose turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * rotation_from_json(json));
  Eigen::AlignedBox3d box;
  for (GltfPart& part : cup.parts) {
    part.transform(turn);
    for (const Eigen::Vector3d& vertex : part.mesh.vertices) box.extend(vertex);
  }
  constexpr double kSmallestMm = 1.0;
  const double size_mm = mm_from_metres(box.sizes().maxCoeff());
  if (!(size_mm >= kSmallestMm && size_mm <= kCupLengthMm.high))
    shape.fail(fmt::format("{} is {:g} mm large, must be from {} to {} mm; lengths in glTF are metres", cup.name,
                           size_mm, kSmallestMm, kCupLengthMm.high));
  const Pose place(put_down(json, box.min().z()));
  for (GltfPart& part : cup.parts) part.transform(place);
  cup.world_from_mesh = place * turn;
  return cup;
}

/// What looking for the inside takes goes with the triangles' area. A cup has some times the area of the box around it;
/// one mesh placed a thousand times at the same place has a thousand times.
void require_modest_area(const JsonReader& json, const MeshCup& cup) {
  constexpr double kMostOfBox = 100.0;
  double area = 0.0;
  Eigen::AlignedBox3d box;
  for (const GltfPart& part : cup.parts) {
    const std::vector<Eigen::Vector3d>& v = part.mesh.vertices;
    for (const Eigen::Vector3i& t : part.mesh.triangles)
      area += 0.5 * (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).norm();
    for (const Eigen::Vector3d& vertex : v) box.extend(vertex);
  }
  const Eigen::Vector3d size = box.sizes();
  const double of_box = 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  if (area > kMostOfBox * of_box)
    json.fail_at("shape",
                 fmt::format("{} has triangles of {:.0f} times the area of the box around it, at most {:g} times "
                             "can be searched for its inside",
                             cup.name, area / of_box, kMostOfBox));
}

void find_cavity_of(const JsonReader& json, MeshCup& cup) {
  require_modest_area(json, cup);
  std::vector<Mesh> meshes;
  std::map<int, Mesh> clear_bodies;
  for (const GltfPart& part : cup.parts) {
    if (part.medium) clear_bodies[part.body].append(part.mesh);
    meshes.push_back(part.mesh);
  }
  for (const auto& [number, body] : clear_bodies)
    if (!encloses_volume(body))
      json.fail_at("shape", fmt::format("{} is clear and its wall is open or turned inside out; to be filled, a clear "
                                        "wall must be closed, its triangles facing out of it",
                                        cup.name));
  const std::optional<Cavity> cavity = find_cavity(meshes);
  if (!cavity)
    json.fail_at("shape",
                 fmt::format("{} holds no liquid; a cup must be open above and have no opening wider than 1 mm below",
                             cup.name));
  cup.cavity = std::make_shared<const Cavity>(*cavity);
}

/// " (it spills at x 40.0, y 400.0, z 87.0 mm)" for meshes.
std::string where_it_spills(const Cup& cup) {
  const auto* mesh = std::get_if<MeshCup>(&cup.shape);
  if (!mesh) return "";
  const Eigen::Vector3d spill = mesh->cavity->spill() / kMetresPerMm;
  return fmt::format(" (it spills at x {:.1f}, y {:.1f}, z {:.1f} mm)", spill.x(), spill.y(), spill.z());
}

double depth_from_json(const JsonReader& json, const Cup& cup) {
  if (json.has("fill_ml") && json.has("fill_mm")) json.fail_at("fill_ml", "cannot stand beside fill_mm");
  if (!json.has("fill_ml")) {
    constexpr double kRounding = 1e-8;  // [m]; rims of meshes are known to a nanometre
    const double limit = cup_depth(cup), depth = metres_from_mm(json.number("fill_mm", kNonNegative));
    if (depth > limit + kRounding)
      json.fail_at("fill_mm", fmt::format("must be at most {:.6g}, the depth of the cup{}", mm_from_metres(limit),
                                          where_it_spills(cup)));
    return std::min(depth, limit);
  }
  constexpr double kSame = 5e-3;  // of a volume: more has flowed over an inner rim
  const double limit = cup_capacity(cup), volume = cubic_metres_from_ml(json.number("fill_ml", kNonNegative));
  if (volume > limit)
    json.fail_at("fill_ml", fmt::format("must be at most {:.6g}, what the cup holds{}", ml_from_cubic_metres(limit),
                                        where_it_spills(cup)));
  if (volume == 0.0) return 0.0;
  const double depth = depth_of_volume(cup, volume);
  if (std::fabs(cup_volume(cup, depth) - volume) > kSame * volume)
    json.fail_at("fill_ml", fmt::format("must not be reached while the liquid flows over an inner rim, {:.4g} mm deep",
                                        mm_from_metres(depth)));
  return depth;
}

std::span<const Field<Ripple>> ripple_fields() {
  static const Field<Ripple> fields[] = {
      {"wavelength_mm", Length{&Ripple::wavelength}, kLengthMm, "from crest to crest", true},
      {"amplitude_mm", Length{&Ripple::amplitude}, kLengthOrNoneMm, "of the sine", true},
      {"azimuth_deg", Angle{&Ripple::azimuth}, "direction in which the phase grows, from +x towards +y"},
      {"phase_deg", Angle{&Ripple::phase}, "at the cup's axis; 0: level there, rising"}};
  return fields;
}

Ripple ripple_from_json(const JsonReader& json) {
  Ripple ripple{};
  read_fields(json, ripple_fields(), ripple);
  return ripple;
}

std::span<const Field<Wetting>> wetting_fields() {
  static const Field<Wetting> fields[] = {
      {"contact_angle_deg",
       Angle{&Wetting::contact_angle},
       {1.0, 179.0},
       "of the meniscus at an upright wall, in the liquid: Young and Laplace's profile, up below 90°"},
      {"capillary_length_mm", Length{&Wetting::capillary_length}, kLengthMm,
       "of the liquid, beside `contact_angle_deg`"}};
  return fields;
}

std::span<const Field<LiquidForm>> surface_fields() {
  static const Field<LiquidForm> fields[] = {
      {"tilt_deg", Angle{&LiquidForm::tilt}, {0.0, 45.0}, "of the surface, as a plane"},
      {"tilt_azimuth_deg", Angle{&LiquidForm::tilt_azimuth}, "direction in which it rises, from +x towards +y"},
      {"ripples",
       Part<LiquidForm>{[](const JsonReader& json, LiquidForm& form) {
                          for (const JsonReader& ripple : json.items())
                            form.ripples.push_back(ripple_from_json(ripple));
                        },
                        nullptr, R"({"type": "array", "items": {"$ref": "#/$defs/ripple"}})", "a list of objects"},
       "sines across the surface, which are added"}};
  return fields;
}

LiquidForm form_from_json(const JsonReader& json) {
  std::vector<std::string_view> of_wetting;
  for (const auto& field : wetting_fields()) of_wetting.push_back(field.key);
  LiquidForm form;
  read_fields(json, surface_fields(), form, of_wetting);
  if (std::ranges::any_of(of_wetting, [&](std::string_view key) { return json.has(key); })) {
    form.wetting.emplace();
    for (const auto& field : wetting_fields()) field.read(json.at(field.key), *form.wetting);
  }
  return form;
}

/// The surface must stay between the cup's bottom and its rim.
void check_form(const JsonReader& json, const CupShape& shape, const Filling& filling) {
  const LiquidForm& form = filling.form;
  const double level = shape.bottom() + filling.depth;
  double up = std::tan(form.tilt) * shape.inner_radius(level), down = up;
  for (const Ripple& ripple : form.ripples) up += ripple.amplitude, down += ripple.amplitude;
  if (form.wetting) {
    const double contact = contact_height(shape, level, *form.wetting), rise = contact - level;
    const double lean = shape.wall_lean(contact);
    if (form.wetting->contact_angle + lean <= 0.0 || form.wetting->contact_angle + lean >= std::numbers::pi)
      json.fail_at("contact_angle_deg", fmt::format("must be above {:g} and below {:g} at this wall, which leans",
                                                    -deg_from_radians(lean), 180.0 - deg_from_radians(lean)));
    (rise > 0.0 ? up : down) += std::fabs(rise);
  }
  if (level + up > shape.height())
    json.fail(fmt::format("lifts the liquid to {:g} mm above the desk, over the rim at {:g}",
                          mm_from_metres(level + up), mm_from_metres(shape.height())));
  if (down >= filling.depth)
    json.fail(fmt::format("lowers the liquid by {:g} mm, to the bottom at {:g} mm below its level",
                          mm_from_metres(down), mm_from_metres(filling.depth)));
}

void pour(const JsonReader& json, Cup& cup) {
  Filling filling;
  filling.medium = medium_from_json(json.at("liquid"));
  filling.depth = depth_from_json(json, cup);
  if (json.has("surface")) {
    const auto* shape = std::get_if<CupShape>(&cup.shape);
    if (!shape) json.fail_at("surface", "is for cups of revolution; a liquid in a glTF cup is level");
    filling.form = form_from_json(json.at("surface"));
    check_form(json.at("surface"), *shape, filling);
  }
  if (filling.depth == 0.0) return;
  cup.filling = std::move(filling);
  if (liquid_surface(cup).triangles.empty())
    json.fail_at(json.has("fill_ml") ? "fill_ml" : "fill_mm", "is too little to have a surface in this cup");
}

std::span<const Field<Cup>> cup_fields() {
  static const Field<Cup> fields[] = {
      {"shape",
       unread<Cup>(R"({"anyOf": [{"type": "string"}, {"$ref": "#/$defs/shape"}]})", "a name, a path or an object"),
       "a name of `fathom list cups`, a glTF file (*.gltf, *.glb) relative to this file, or a description", true},
      {"position_mm",
       unread<Cup>(R"({"type": "array", "items": {"$ref": "#/$defs/cup_place"}, "minItems": 2, "maxItems": 3})",
                   "[x, y] or [x, y, z]"),
       "of the axis, or the glTF file's origin, on the desk; z, of glTF cups only: height of the lowest point", true},
      {"rotation_deg", unread<Cup>("#/$defs/vector3", "[x, y, z]"),
       "of glTF cups only: about the fixed axes x, then y, then z, before `yaw_deg`"},
      {"yaw_deg", Angle{&Cup::yaw}, "direction of the handle, from +x towards +y"},
      {"glaze", unread<Cup>("#/$defs/glaze", "an object"),
       "a clear coat, which mirrors and through which the albedo is seen; of opaque cups of revolution"},
      {"liquid",
       unread<Cup>(R"({"anyOf": [{"type": "string"}, {"$ref": "#/$defs/changed_liquid"}, {"$ref": "#/$defs/liquid"}]})",
                   "a name or an object"),
       "a name of `fathom list media`, that name with a temperature or a dilution, or a description"},
      {"fill_mm", Part<Cup>{}, kNonNegative, "depth of the liquid above the lowest point of the cup's inside"},
      {"fill_ml", Part<Cup>{}, kNonNegative, "its volume, instead of `fill_mm`"},
      {"surface", unread<Cup>("#/$defs/surface", "an object"),
       "what makes it other than level; of cups of revolution"}};
  return fields;
}

}  // namespace

Cup cup_from_json(const JsonReader& json) {
  Cup cup;
  read_fields(json, cup_fields(), cup);
  const JsonReader shape = json.at("shape");
  const bool is_mesh = shape.value().is_string() && names_gltf(shape.text());
  if (is_mesh) {
    cup.shape = mesh_cup_from_json(json, cup.yaw);
    if (json.has("glaze")) json.fail_at("glaze", "is for cups of revolution; glTF materials have roughnessFactor");
  } else {
    CupShape revolved = cup_shape_from_json(shape);
    revolved.glaze = glaze_from_json(json);
    if (revolved.glaze && revolved.material) json.fail_at("glaze", "is for opaque walls; this one is clear");
    cup.shape = std::move(revolved);
    cup.position = json.at("position_mm").vector2(kCupPlaceMm) * kMetresPerMm;
    if (json.has("rotation_deg")) json.fail_at("rotation_deg", "is for cups from glTF files; others have yaw_deg");
  }
  if (!json.has("liquid")) {
    for (const char* key : {"fill_mm", "fill_ml", "surface"})
      if (json.has(key)) json.fail_at(key, "needs a liquid");
    return cup;
  }
  if (is_mesh) find_cavity_of(json, std::get<MeshCup>(cup.shape));
  pour(json, cup);
  return cup;
}

std::vector<KeyTable> cup_key_tables() {
  std::vector<KeyRow> surface = key_rows(wetting_fields(), Wetting{});
  for (KeyRow& row : surface) row.standard = nullptr;
  for (KeyRow& row : key_rows(surface_fields(), LiquidForm{})) surface.push_back(std::move(row));
  return {{"cups[]", "cup", "Cup", key_rows(cup_fields(), Cup{})},
          {"cups[].surface", "surface", "A liquid's surface", std::move(surface)},
          {"cups[].surface.ripples[]", "ripple", "Ripple", key_rows(ripple_fields(), Ripple{})}};
}

}  // namespace fathom
