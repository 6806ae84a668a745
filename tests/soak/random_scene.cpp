#include "tests/soak/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/files.h"
#include "core/library.h"
#include "core/rng.h"
#include "core/units.h"
#include "tests/render/gltf_slab.h"
#include "tests/scene/vessels.h"
#include "tests/scene/write_gltf.h"

namespace fathom {
namespace {

/// Draws from one stream.
class Draw {
 public:
  explicit Draw(Rng rng) : rng_(rng) {}

  double from(double low, double high) { return low + (high - low) * rng_.uniform(); }
  /// Evenly in the logarithm.
  double scale(double low, double high) { return low * std::pow(high / low, rng_.uniform()); }
  int whole(int low, int high) {
    return low + static_cast<int>(rng_.below(static_cast<std::uint32_t>(high - low + 1)));
  }
  bool chance(double share) { return rng_.uniform() < share; }
  template <class T>
  T one_of(const std::vector<T>& choices) {
    return choices[rng_.below(static_cast<std::uint32_t>(choices.size()))];
  }

 private:
  Rng rng_;
};

Json random_noise(Draw& draw) {
  if (draw.chance(0.7)) return draw.chance(0.7) ? "off" : "basic";
  return {{"speckle_shape", draw.chance(0.5) ? 0.0 : draw.from(1.0, 9.0)},
          {"electrons_per_dn", draw.from(0.0, 20.0)},
          {"read_dn", draw.from(0.0, 20.0)},
          {"bits", draw.whole(0, 16)}};
}

Json random_pattern(Draw& draw) {
  const int columns = draw.whole(40, 80), rows = draw.whole(40, 80);
  const double step_px = draw.from(0.6, 1.5);
  return {{"tile_columns", columns},
          {"tile_rows", rows},
          {"tiles_across", draw.whole(1, 4)},
          {"tiles_down", draw.whole(1, 4)},
          {"step_px", step_px},
          {"dots_per_tile", columns * rows * draw.whole(10, 12) / 100},
          {"dot_sigma_ir_px", draw.from(0.3, std::min(1.2 * step_px, 2.0))},
          {"seed", draw.whole(0, 1000)}};
}

/// A small sensor that looks at `target_mm` from anywhere above the desk, now and then past it. It mostly stands well
/// off, for the search of the projector's directions takes long where clear bodies fill its view.
Json random_sensor(Draw& draw, const Eigen::Vector2d& target_mm) {
  const int width = draw.whole(16, 18), height = draw.whole(16, 18);
  Json sensor = {{"height_mm", draw.chance(0.02) ? draw.from(20.0, 400.0) : draw.from(900.0, 1500.0)},
                 {"baseline_mm", draw.scale(10.0, 200.0)},
                 {"ir_size_px", {2 * width, 2 * (height + draw.whole(0, 3))}},
                 {"depth_size_px", {width, height}},
                 {"focal_px", width * draw.scale(0.5, 16.0)},
                 {"reference_mm", draw.from(400.0, 2000.0)},
                 {"near_mm", draw.from(10.0, 500.0)},
                 {"far_mm", draw.from(600.0, 10000.0)},
                 {"noise", random_noise(draw)},
                 {"quantization", draw.chance(0.5) ? "device" : "off"},
                 {"pattern", random_pattern(draw)},
                 {"matcher",
                  {{"window_columns", 2 * draw.whole(1, 6) + 1},
                   {"window_rows", 2 * draw.whole(1, 6) + 1},
                   {"disparity_min_px", -draw.whole(0, 20)},
                   {"disparity_max_px", draw.whole(1, 30)}}}};
  if (draw.chance(0.3)) sensor["principal_px"] = {width * draw.from(0.2, 0.8), height * draw.from(0.2, 0.8)};
  if (draw.chance(0.3)) sensor["roll_deg"] = draw.from(-180.0, 180.0);
  if (draw.chance(0.15))
    sensor["pitch_deg"] = draw.chance(0.3) ? 90.0 : draw.from(0.0, 90.0);
  else
    sensor["aim_mm"] = {target_mm.x() + draw.from(-20.0, 20.0), target_mm.y() + draw.from(-20.0, 20.0),
                        draw.from(0.0, 40.0)};
  return sensor;
}

Json random_profile(Draw& draw, double height_mm, double bottom_mm, double wall_mm) {
  Json inner = {{0.0, bottom_mm}}, outer = {{0.0, 0.0}};
  const int corners = draw.whole(2, 5);
  double inner_mm = draw.scale(8.0, 20.0);
  if (draw.chance(0.7)) inner.push_back({inner_mm, bottom_mm});
  for (const double z_mm : {0.0, bottom_mm}) outer.push_back({inner_mm + wall_mm, z_mm});
  for (int corner = 1; corner < corners; ++corner) {
    inner_mm = std::max(inner_mm + draw.from(-6.0, 6.0), 5.0);
    const double z_mm = bottom_mm + (height_mm - bottom_mm) * corner / (corners - 1);
    inner.push_back({inner_mm, z_mm});
    outer.push_back({inner_mm + wall_mm, z_mm});
  }
  if (inner.size() < 3) inner.push_back({inner_mm + 0.5 * wall_mm, height_mm});
  return {{"inner_profile_mm", inner}, {"outer_profile_mm", outer}};
}

/// A cup of revolution that is described, not named.
Json random_shape(Draw& draw) {
  const double height_mm = draw.scale(12.0, 80.0), bottom_mm = std::min(draw.scale(0.5, 15.0), 0.5 * height_mm);
  const double wall_mm = draw.scale(0.3, 8.0), inner_mm = draw.scale(6.0, 20.0);
  Json shape;
  if (draw.chance(0.4))
    shape = random_profile(draw, height_mm, bottom_mm, wall_mm);
  else
    shape = {{"height_mm", height_mm},
             {"bottom_mm", bottom_mm},
             {"inner_radius_mm", inner_mm},
             {"outer_radius_mm", inner_mm + wall_mm}};
  if (draw.chance(0.7)) {
    shape["albedo"] = draw.chance(0.1) ? 1.0 : draw.from(0.0, 1.0);
    if (draw.chance(0.3))
      shape["handle"] = {{"low_mm", 0.2 * height_mm}, {"high_mm", 0.8 * height_mm}, {"reach_mm", draw.from(5.0, 20.0)}};
  } else if (draw.chance(0.5)) {
    shape["material"] = draw.one_of(library_names("walls"));
  } else {
    shape["material"] = {{"index", draw.from(1.0, 2.0)}, {"absorption_per_mm", draw.scale(1e-4, 0.3)}};
  }
  return shape;
}

/// In full light a thin one: walks in a turbid liquid that is not level join every place that they come to to the
/// projector, which takes minutes.
Json random_liquid(Draw& draw, LightModel light) {
  const double most = light == LightModel::full ? 0.01 : 1.0;
  if (light == LightModel::direct && draw.chance(0.4)) return draw.one_of(library_names("media"));
  if (draw.chance(0.3))
    return {{"name", draw.one_of(library_names("media"))},
            {"temperature_c", draw.from(0.0, 100.0)},
            {"dilution", draw.scale(1e-3 * most, most)}};
  Json liquid = {{"index", draw.chance(0.1) ? 1.0 : draw.from(1.0, 2.0)}};
  if (draw.chance(0.7)) liquid["absorption_per_mm"] = draw.scale(1e-4, 1.0);
  if (draw.chance(0.4)) {
    liquid["scattering_per_mm"] = draw.scale(1e-3, 10.0 * most);
    liquid["anisotropy"] = draw.from(-0.95, 0.99);
  }
  return liquid;
}

/// Waves, slope and meniscus that fit between the bottom and the rim of most cups.
Json random_surface(Draw& draw, double depth_mm, double headroom_mm, double radius_mm, double wall_lean_deg) {
  const double room_mm = 0.3 * std::min(depth_mm, headroom_mm);
  Json surface = Json::object();
  if (draw.chance(0.5)) {
    surface["tilt_deg"] = deg_from_radians(std::atan(draw.from(0.0, 0.7) * std::min(room_mm / radius_mm, 1.0)));
    surface["tilt_azimuth_deg"] = draw.from(-360.0, 360.0);
  }
  if (draw.chance(0.5)) {
    const double angle_deg = room_mm > 2.0 ? draw.from(5.0, 175.0) : draw.from(75.0, 105.0);
    surface["contact_angle_deg"] = std::clamp(angle_deg, 5.0 - wall_lean_deg, 175.0 - wall_lean_deg);
    surface["capillary_length_mm"] = std::min(draw.from(1.0, 4.0), 0.5 * std::max(room_mm, 0.5));
  }
  if (draw.chance(0.4)) {
    surface["ripples"] = Json::array();
    for (int ripple = draw.whole(1, 3); ripple > 0; --ripple) {
      const double wavelength_mm = draw.scale(3.0, 60.0);
      surface["ripples"].push_back(
          {{"wavelength_mm", wavelength_mm},
           {"amplitude_mm", draw.from(0.0, 1.0) * std::min(0.05 * wavelength_mm, 0.3 * room_mm)},
           {"azimuth_deg", draw.from(-180.0, 180.0)},
           {"phase_deg", draw.from(-180.0, 180.0)}});
    }
  }
  return surface;
}

/// A cup of revolution, named or described, filled or not.
Json random_cup(Draw& draw, const Eigen::Vector2d& position_mm, LightModel light) {
  const Json shape = draw.chance(0.1) ? Json(draw.one_of(library_names("cups"))) : random_shape(draw);
  Json cup = {{"shape", shape}, {"position_mm", {position_mm.x(), position_mm.y()}}};
  if (draw.chance(0.3)) cup["yaw_deg"] = draw.from(-360.0, 360.0);
  if (!shape.contains("material") && draw.chance(0.2))
    cup["glaze"] = {{"roughness", draw.scale(kLeastRoughness, 1.0)}, {"index", draw.from(1.0, 2.0)}};
  if (draw.chance(0.2)) return cup;
  cup["liquid"] = random_liquid(draw, light);
  const CupShape read = cup_shape_from_json(JsonReader(cup["shape"], "soak"));
  const double room_mm = mm_from_metres(read.height() - read.bottom());
  const double depth_mm = draw.chance(0.05) ? room_mm : room_mm * draw.from(0.02, 0.99);
  if (draw.chance(0.2))
    cup["fill_ml"] = ml_from_cubic_metres(read.volume(metres_from_mm(depth_mm)));
  else
    cup["fill_mm"] = depth_mm;
  const double level = read.bottom() + metres_from_mm(depth_mm);
  if (draw.chance(0.3))
    cup["surface"] = random_surface(draw, depth_mm, room_mm - depth_mm, mm_from_metres(read.inner_radius(level)),
                                    deg_from_radians(read.wall_lean(level)));
  return cup;
}

/// A cup from a glTF file, an opaque sheet of triangles or a clear body of few sides: a small one, for its cavity is
/// searched in voxels of half a millimetre.
Json random_gltf_cup(Draw& draw, const Eigen::Vector2d& position_mm, LightModel light,
                     const std::filesystem::path& folder) {
  const double bottom = draw.from(0.006, 0.012), rim = bottom + draw.from(0.0, 0.006), height = draw.from(0.015, 0.04);
  std::string file = "cup.gltf";
  if (draw.chance(0.5)) {
    const double wall = draw.from(0.0005, 0.003), index = draw.from(1.0, 2.0);
    const int sides = draw.whole(3, 24);
    const std::vector<Eigen::Vector2d> profile = {{0.0, 0.0},    {bottom + wall, 0.0}, {rim + wall, height},
                                                  {rim, height}, {bottom, wall},       {0.0, wall}};
    make_directory(folder / "clear");
    write_clear_gltf(folder / "clear", sheet_of_revolution(profile, sides), index, 0.0);
    file = "clear/body.gltf";
  } else {
    write_gltf(folder / file, sheet_of_revolution({{0.0, 0.0}, {bottom, 0.0}, {rim, height}}), draw.from(0.0, 1.0));
  }
  Json cup = {{"shape", file}, {"position_mm", {position_mm.x(), position_mm.y()}}};
  if (draw.chance(0.5)) cup["rotation_deg"] = {draw.from(-15.0, 15.0), draw.from(-15.0, 15.0), 0.0};
  if (draw.chance(0.8)) {
    cup["liquid"] = random_liquid(draw, light);
    cup["fill_mm"] = mm_from_metres(height) * draw.from(0.05, 0.6);
  }
  return cup;
}

/// A prism, opaque or clear.
Json random_object(Draw& draw, const Eigen::Vector2d& position_mm, const std::filesystem::path& folder) {
  const int sides = draw.whole(3, 12);
  const double radius = draw.from(0.005, 0.02), height = draw.from(0.002, 0.04);
  const Mesh mesh = prism(sides, radius, 0.0, height);
  const double index = draw.from(1.0, 2.0);
  if (draw.chance(0.3))
    write_gltf(folder / "body.gltf", mesh);
  else
    write_clear_gltf(folder, mesh, index, draw.scale(1e-4, 0.1));
  return {{"gltf", "body.gltf"},
          {"position_mm", {position_mm.x(), position_mm.y(), draw.from(-5.0, 100.0)}},
          {"rotation_deg", {draw.from(-180.0, 180.0), draw.from(-180.0, 180.0), draw.from(-180.0, 180.0)}}};
}

}  // namespace

RandomShot write_random_scene(std::uint64_t seed, std::uint64_t number, const std::filesystem::path& folder) {
  Draw draw(Rng(seed, number));
  const RandomShot shot{draw.chance(0.4) ? CaptureMode::geometric : CaptureMode::photometric,
                        draw.chance(0.15) ? LightModel::full : LightModel::direct};
  const Eigen::Vector2d middle_mm{draw.from(-150.0, 150.0), draw.from(50.0, 700.0)};
  const auto nearby = [&](double reach_mm) {
    const double x_mm = middle_mm.x() + draw.from(-reach_mm, reach_mm);
    return Eigen::Vector2d(x_mm, middle_mm.y() + draw.from(-reach_mm, reach_mm));
  };
  Json scene = {{"sensor", random_sensor(draw, middle_mm)}};
  if (draw.chance(0.1))
    scene["desk"] = nullptr;
  else
    scene["desk"] = {{"albedo", draw.from(0.0, 1.0)},
                     {"size_mm", {draw.from(100.0, 3000.0), draw.from(100.0, 3000.0)}}};
  scene["cups"] = Json::array();
  if (draw.chance(0.95)) scene["cups"].push_back(random_cup(draw, middle_mm, shot.light));
  while (draw.chance(0.12)) scene["cups"].push_back(random_cup(draw, nearby(150.0), shot.light));
  if (draw.chance(0.01)) scene["cups"].push_back(random_gltf_cup(draw, nearby(100.0), shot.light, folder));
  if (draw.chance(0.1)) scene["objects"] = Json::array({random_object(draw, nearby(80.0), folder)});
  write_json(folder / "scene.json", scene);
  return shot;
}

}  // namespace fathom
