// Small scenes for the tests of light transport and of the sensor.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "core/json.h"
#include "core/rng.h"
#include "core/units.h"
#include "sim/render/connection.h"
#include "sim/scene/setup.h"

namespace fathom {

/// The paper's cup with `fill_mm` of water (0: empty) at a distance, the sensor 650 mm high. `more` goes into "sensor".
inline Setup cup_setup(double fill_mm, double distance_mm, double aim_mm, const std::string& more = "") {
  const std::string liquid = fill_mm > 0.0 ? fmt::format(R"(, "liquid": "water", "fill_mm": {})", fill_mm) : "";
  return setup_from_json(
      Json::parse(fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, {}, 0]{}}},
                                   "cups": [{{"shape": "paper_cup", "position_mm": [0, {}]{}}}]}})",
                              aim_mm, more, distance_mm, liquid)),
      "test");
}

inline Setup desk_setup(const std::string& more = "") {
  return setup_from_json(
      Json::parse(fmt::format(
          R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 400, 0]{}}}, "desk": {{}}}})",
          more)),
      "test");
}

/// A scene, its surfaces, and the light that its projector casts.
struct LitScene {
  explicit LitScene(const Setup& setup)
      : rig(setup.rig),
        geometry(build_geometry(setup.scene, rig.sensor.wavelength_nm)),
        world(geometry),
        projector(world, rig.projector_in_world()) {}

  Ray camera_ray(const Eigen::Vector3d& at) const {
    return {rig.camera_in_world(), (at - rig.camera_in_world()).normalized()};
  }
  std::vector<Connection> connections(const Eigen::Vector3d& point, const Body* around) const {
    std::vector<Connection> found;
    projector.connect({point, around}, [&](const Connection& way) { found.push_back(way); });
    return found;
  }

  Rig rig;
  Geometry geometry;
  Intersector world;
  PointLight projector;
};

/// Power [of unit radiant intensity] of rays that leave the projector evenly in a cone of 0.1 rad about `target`, which
/// holds a cup 300 mm away: `power_of(direction, rng)` is what becomes of one.
template <class Power>
Estimate power_of_cone(const LitScene& scene, const Eigen::Vector3d& target, int rays, Rng rng, Power power_of) {
  constexpr double kCone = 0.1;  // [rad] a glass fills 0.15 in width
  const Eigen::Vector3d axis = (target - scene.projector.position()).normalized();
  const Matrix32d basis = perpendicular_to(axis);
  Mean power;
  for (int i = 0; i < rays; ++i) {
    const double cosine = 1.0 - rng.uniform() * (1.0 - std::cos(kCone));
    const Eigen::Vector2d aside =
        std::sqrt(1.0 - cosine * cosine) * direction_of(2.0 * std::numbers::pi * rng.uniform());
    power.add(power_of(cosine * axis + basis * aside, rng));
  }
  const double solid_angle = 2.0 * std::numbers::pi * (1.0 - std::cos(kCone));
  return {solid_angle * power.estimate().value, solid_angle * power.estimate().standard_error};
}

/// Closes a scene with the walls of a black room, its last object, so that every ray ends.
inline void add_room(Geometry& geometry) {
  Mesh room;
  for (const double z : {-0.5, 2.0})
    for (const double y : {-2.0, 2.0})
      for (const double x : {-2.0, 2.0}) room.add_vertex({x, y, z});
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kSides) room.add_triangle(a, b, c), room.add_triangle(a, c, d);
  geometry.objects.push_back("room");
  geometry.surfaces.push_back({static_cast<int>(geometry.objects.size()), std::move(room), Diffuse{0.0}});
}

/// The sensor over a cup of the given shape at 300 mm; `more` goes into the cup. `file` is where the scene would stand.
inline Setup cup_of(const std::string& shape, const std::string& more, const std::string& file = "test") {
  return setup_from_json(Json::parse(fmt::format(R"({{"sensor": {{"height_mm": 650, "aim_mm": [0, 300, 0]}},
                                   "cups": [{{"shape": {}, "position_mm": [0, 300]{}}}]}})",
                                                 shape, more)),
                         file);
}

/// The same over a cup that is a glTF file.
inline Setup gltf_cup_of(const std::filesystem::path& gltf, const std::string& more) {
  return cup_of(Json(gltf.filename().string()).dump(), more, (gltf.parent_path() / "scene.json").string());
}

inline constexpr const char* kPaperCup = "\"paper_cup\"";
inline constexpr const char* kGlassCup = R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40,
    "outer_radius_mm": 43, "material": {"index": 1.51, "absorption_per_mm": 0.044}})";
inline constexpr const char* kWater = R"(, "liquid": {"index": 1.3281, "absorption_per_mm": 0.0031}, "fill_mm": 30)";
inline constexpr const char* kMeniscus = R"(, "surface": {"contact_angle_deg": 30, "capillary_length_mm": 2.73})";
inline constexpr const char* kTilted = R"(, "surface": {"tilt_deg": 8, "tilt_azimuth_deg": 40})";
inline constexpr const char* kRippled = R"(, "surface": {"contact_angle_deg": 70, "capillary_length_mm": 2.73,
    "tilt_deg": 1, "ripples": [{"wavelength_mm": 15, "amplitude_mm": 0.2, "azimuth_deg": 20},
                               {"wavelength_mm": 9, "amplitude_mm": 0.05, "azimuth_deg": 100, "phase_deg": 50}]})";

/// Height of the inner bottom of the paper's cup above the desk [m].
inline constexpr double kPaperCupBottom = 0.007;

}  // namespace fathom
