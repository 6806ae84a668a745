#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.h"
#include "sim/optics/meniscus.h"
#include "sim/scene/library.h"

namespace fathom {
namespace {

constexpr Range kAlbedo{0.0, 1.0};

Desk desk_from_json(const JsonReader& json) {
  json.allow_only({"albedo", "size_mm", "centre_mm"});
  Desk desk;
  desk.albedo = json.number_or("albedo", desk.albedo, kAlbedo);
  if (json.has("size_mm")) desk.size = json.at("size_mm").vector2() * kMetresPerMm;
  if (json.has("centre_mm")) desk.centre = json.at("centre_mm").vector2() * kMetresPerMm;
  if (desk.size.minCoeff() <= 0.0) json.fail_at("size_mm", "must be two lengths above 0");
  return desk;
}

Handle handle_from_json(const JsonReader& json) {
  json.allow_only({"low_mm", "high_mm", "reach_mm", "tube_radius_mm"});
  Handle handle;
  handle.low = metres_from_mm(json.number_or("low_mm", mm_from_metres(handle.low), kPositive));
  handle.high = metres_from_mm(json.number_or("high_mm", mm_from_metres(handle.high), kPositive));
  handle.reach = metres_from_mm(json.number_or("reach_mm", mm_from_metres(handle.reach), kPositive));
  handle.tube_radius = metres_from_mm(json.number_or("tube_radius_mm", mm_from_metres(handle.tube_radius), kPositive));
  if (handle.high <= handle.low) json.fail_at("high_mm", "must be above low_mm");
  return handle;
}

std::vector<Eigen::Vector2d> profile_from_json(const JsonReader& json) {
  std::vector<Eigen::Vector2d> profile;
  for (const JsonReader& item : json.items()) {
    profile.push_back(item.vector2() * kMetresPerMm);
    if (profile.back().minCoeff() < 0.0) item.fail("must be a radius and a height of at least 0");
    if (profile.size() > 1 && profile.back().y() < profile[profile.size() - 2].y())
      item.fail("must not be lower than the point before it");
  }
  if (profile.size() < 3) json.fail("must hold at least 3 points, from the axis to the rim");
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
  const double height = metres_from_mm(json.number("height_mm", kPositive));
  const double bottom = metres_from_mm(json.number("bottom_mm", kPositive));
  const double inner = metres_from_mm(json.number("inner_radius_mm", kPositive));
  const double outer = metres_from_mm(json.number("outer_radius_mm", kPositive));
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

Ripple ripple_from_json(const JsonReader& json) {
  json.allow_only({"wavelength_mm", "amplitude_mm", "azimuth_deg", "phase_deg"});
  return {.wavelength = metres_from_mm(json.number("wavelength_mm", kPositive)),
          .amplitude = metres_from_mm(json.number("amplitude_mm", kNonNegative)),
          .azimuth = radians_from_deg(json.number_or("azimuth_deg", 0.0)),
          .phase = radians_from_deg(json.number_or("phase_deg", 0.0))};
}

LiquidForm form_from_json(const JsonReader& json) {
  json.allow_only({"contact_angle_deg", "capillary_length_mm", "tilt_deg", "tilt_azimuth_deg", "ripples"});
  LiquidForm form;
  form.tilt = radians_from_deg(json.number_or("tilt_deg", 0.0, {0.0, 45.0}));
  form.tilt_azimuth = radians_from_deg(json.number_or("tilt_azimuth_deg", 0.0));
  for (const JsonReader& ripple : json.items_or_none("ripples")) form.ripples.push_back(ripple_from_json(ripple));
  if (json.has("contact_angle_deg") || json.has("capillary_length_mm"))
    form.wetting = Wetting{radians_from_deg(json.number("contact_angle_deg", {1.0, 179.0})),
                           metres_from_mm(json.number("capillary_length_mm", kPositive))};
  return form;
}

/// The surface must stay between the cup's bottom and its rim.
void check_form(const JsonReader& json, const CupShape& shape, const Filling& filling) {
  const LiquidForm& form = filling.form;
  const double level = shape.bottom() + filling.depth;
  double up = std::tan(form.tilt) * shape.inner_radius(level), down = up;
  for (const Ripple& ripple : form.ripples) up += ripple.amplitude, down += ripple.amplitude;
  if (form.wetting) {
    const double lean = shape.wall_lean(level);
    if (form.wetting->contact_angle + lean <= 0.0 || form.wetting->contact_angle + lean >= std::numbers::pi)
      json.fail_at("contact_angle_deg", fmt::format("must be above {:g} and below {:g} at this wall, which leans",
                                                    -deg_from_radians(lean), 180.0 - deg_from_radians(lean)));
    const double rise = Meniscus(form.wetting->contact_angle, form.wetting->capillary_length, lean).rise();
    (rise > 0.0 ? up : down) += std::fabs(rise);
  }
  if (level + up > shape.height())
    json.fail(fmt::format("lifts the liquid to {:g} mm above the desk, over the rim at {:g}",
                          mm_from_metres(level + up), mm_from_metres(shape.height())));
  if (down >= filling.depth)
    json.fail(fmt::format("lowers the liquid by {:g} mm, to the bottom at {:g} mm below its level",
                          mm_from_metres(down), mm_from_metres(filling.depth)));
}

Cup cup_from_json(const JsonReader& json) {
  json.allow_only({"shape", "position_mm", "yaw_deg", "liquid", "fill_mm", "surface"});
  Cup cup;
  cup.shape = cup_shape_from_json(json.at("shape"));
  cup.position = json.at("position_mm").vector2() * kMetresPerMm;
  cup.yaw = radians_from_deg(json.number_or("yaw_deg", 0.0));
  if (!json.has("liquid")) {
    for (const char* key : {"fill_mm", "surface"})
      if (json.has(key)) json.fail_at(key, "needs a liquid");
    return cup;
  }
  const double depth_limit = cup.shape.height() - cup.shape.bottom();
  Filling filling;
  filling.medium = medium_from_json(json.at("liquid"));
  filling.depth = metres_from_mm(json.number("fill_mm", kNonNegative));
  if (filling.depth > depth_limit)
    json.fail_at("fill_mm", fmt::format("must be at most {:g}, the depth of the cup", mm_from_metres(depth_limit)));
  if (json.has("surface")) {
    filling.form = form_from_json(json.at("surface"));
    check_form(json.at("surface"), cup.shape, filling);
  }
  if (filling.depth > 0.0) cup.filling = std::move(filling);
  return cup;
}

Object object_from_json(const JsonReader& json) {
  json.allow_only({"gltf", "position_mm", "rotation_deg"});
  Object object;
  object.gltf = std::filesystem::path(json.file()).parent_path() / json.text("gltf");
  const Eigen::Vector3d position = json.has("position_mm")
                                       ? Eigen::Vector3d(json.at("position_mm").vector3() * kMetresPerMm)
                                       : Eigen::Vector3d::Zero();
  const Eigen::Vector3d angles = json.has("rotation_deg") ? json.at("rotation_deg").vector3() : Eigen::Vector3d::Zero();
  // About the fixed world axes x, then y, then z.
  object.world_from_object = Eigen::Translation3d(position) *
                             Eigen::AngleAxisd(radians_from_deg(angles.z()), Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(radians_from_deg(angles.y()), Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(radians_from_deg(angles.x()), Eigen::Vector3d::UnitX());
  return object;
}

void set_index(const JsonReader& json, Medium& medium) {
  constexpr Range kIndex{1.0, 4.0};
  const JsonReader index = json.at("index");
  if (index.value().is_number()) {
    medium.index = ConstantIndex{index.number(kIndex)};
    return;
  }
  index.allow_only({"sellmeier_a", "sellmeier_b_um2", "range_nm"});
  SellmeierIndex law{index.at("sellmeier_a").numbers(), index.at("sellmeier_b_um2").numbers()};
  if (law.a.size() != law.b_um2.size() || law.a.empty())
    index.fail_at("sellmeier_b_um2", "must hold as many numbers as sellmeier_a, at least one");
  const Eigen::Vector2d range = index.at("range_nm").vector2();
  if (range[0] <= 0.0 || range[1] <= range[0])
    index.fail_at("range_nm", "must be two wavelengths above 0, the lower first");
  for (const double b_um2 : law.b_um2) {
    const double resonance_nm = b_um2 > 0.0 ? 1e3 * std::sqrt(b_um2) : 0.0;
    if (resonance_nm >= range[0] && resonance_nm <= range[1])
      index.fail_at("sellmeier_b_um2", fmt::format("has a resonance at {:g} nm, inside range_nm", resonance_nm));
  }
  medium.index = std::move(law);
  medium.wavelength_min_nm = range[0];
  medium.wavelength_max_nm = range[1];
  for (const double wavelength_nm : range) {
    const double n = medium.n(wavelength_nm);
    if (!(n >= kIndex.low && n <= kIndex.high))
      index.fail_at("sellmeier_a",
                    fmt::format("gives the index {:g} at {:g} nm, must be from 1 to 4", n, wavelength_nm));
  }
}

/// A medium described inline or named in a library.
Medium named_medium(const JsonReader& json, const char* library, const char* kind) {
  if (json.value().is_string()) {
    const std::string name = json.text();
    const std::filesystem::path file = library_file(library, kind, name, json.file(), json.pointer());
    const Json text = read_json(file);
    Medium medium = named_medium(JsonReader(text, file.string()), library, kind);
    medium.name = name;
    return medium;
  }
  json.allow_only({"name", "index", "absorption_per_mm", "scattering_per_mm", "anisotropy", "source", "quality"});
  Medium medium;
  medium.name = json.text_or("name", kind);
  set_index(json, medium);
  medium.absorption = per_metre_from_per_mm(json.number_or("absorption_per_mm", 0.0, kNonNegative));
  medium.scattering = per_metre_from_per_mm(json.number_or("scattering_per_mm", 0.0, kNonNegative));
  medium.anisotropy = json.number_or("anisotropy", 0.0, {-0.999, 0.999});
  medium.source = json.text_or("source", "");
  return medium;
}

}  // namespace

double CupShape::inner_radius(double height_above_desk) const { return radius_at(inner, height_above_desk); }
double CupShape::outer_radius(double height_above_desk) const { return radius_at(outer, height_above_desk); }

double CupShape::wall_lean(double height_above_desk) const {
  constexpr double kSpan = 0.5e-3;
  return std::atan((inner_radius(height_above_desk + kSpan) - inner_radius(height_above_desk - kSpan)) / (2.0 * kSpan));
}

CupShape cup_shape_from_json(const JsonReader& json) {
  if (!json.value().is_string()) return shape_from_object(json);
  const std::string name = json.text();
  if (name.ends_with(".gltf") || name.ends_with(".glb"))
    json.fail("glTF cups cannot be filled yet; name a shape of scenes/cups or describe one by its profile");
  const std::filesystem::path file = library_file("cups", "cup shape", name, json.file(), json.pointer());
  const Json text = read_json(file);
  CupShape shape = shape_from_object(JsonReader(text, file.string()));
  shape.name = name;
  return shape;
}

Medium medium_from_json(const JsonReader& json) { return named_medium(json, "media", "liquid"); }

Medium wall_from_json(const JsonReader& json) {
  Medium medium = named_medium(json, "walls", "wall material");
  if (medium.scatters()) json.fail("scatters; a wall of a cup is clear, or opaque with an albedo");
  return medium;
}

Scene scene_from_json(const JsonReader& json) {
  Scene scene;
  if (json.has("desk")) {
    if (json.value()["desk"].is_null())
      scene.desk.reset();
    else
      scene.desk = desk_from_json(json.at("desk"));
  }
  for (const JsonReader& cup : json.items_or_none("cups")) scene.cups.push_back(cup_from_json(cup));
  for (const JsonReader& object : json.items_or_none("objects")) scene.objects.push_back(object_from_json(object));
  return scene;
}

}  // namespace fathom
