#include <fmt/format.h>

#include <cmath>

#include "bench/accuracy.h"
#include "bench/bench_scene.h"
#include "bench/sensor_scenes.h"
#include "core/units.h"
#include "tests/core/temporary_folder.h"
#include "tests/render/gltf_slab.h"

namespace fathom {
namespace {

constexpr int kIrWidth = 160, kIrHeight = 128;  ///< infrared pixels about the middle, all that is looked at
constexpr double kDistance = 1.063;             ///< [m] in which a Kinect v1 measured both
constexpr double kTilt = 15.0;                  ///< [deg] which keeps the projector's mirror image out of sight

/// A plate of translucent plastic, `thickness` [m], that hides the wall behind it.
std::filesystem::path write_milky_plate(const std::filesystem::path& folder, double thickness,
                                        double scattering_per_mm) {
  const std::filesystem::path file = write_clear_gltf(folder, prism(4, 0.4, 0.0, thickness), 1.49, 0.0005);
  Json gltf = read_json(file);
  gltf["materials"][0]["extras"].update({{"scattering_per_mm", scattering_per_mm}, {"anisotropy", 0.0}});
  write_json(file, gltf);
  return file;
}

/// Standard deviation over mean of what two infrared images of a scene have in common: of the dots, without speckle and
/// chance.
double contrast(const Image<float>& a, const Image<float>& b) {
  double sum_a = 0.0, sum_b = 0.0, products = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum_a += a.pixels()[i], sum_b += b.pixels()[i];
    products += a.pixels()[i] * b.pixels()[i];
  }
  const double n = static_cast<double>(a.size()), means = sum_a / n * sum_b / n;
  return std::sqrt(std::max(products / n - means, 0.0) / means);
}

struct Figures {
  double contrast;
  TemporalNoise noise;
};

Figures figures_of(const Setup& setup, LightModel light) {
  Camera camera(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, 1, light);
  Camera again(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, 2, light);
  return {contrast(camera.shoot(0).ir, again.shoot(0).ir), temporal_noise(camera)};
}

void compare_milky_plastic() {
  print_title("Milky plastic, 10 mm, 100 mm before a wall, beside a matte face, 1.06 m away");
  const TemporaryFolder folder;
  const Figures matte = figures_of(crop(facing_wall(kDistance, kTilt), kIrWidth, kIrHeight), LightModel::direct);
  print_figure("matte: contrast of the infrared image", matte.contrast, 0.60, "measured, its own");
  print_figure("       valid", matte.noise.valid, 0.987, "measured");
  print_figure("       temporal sigma [mm], mean", matte.noise.mean_mm, 1.05, "measured");
  constexpr double kThickness = 0.010, kBefore = 0.100;  // [m]
  constexpr double kScatteringPerMm = 0.5;
  const std::filesystem::path plate = write_milky_plate(folder / "", kThickness, kScatteringPerMm);
  const Setup setup = wall_with(kDistance + kBefore + kThickness, plate.string(), mm_from_metres(kBefore), kTilt);
  const Figures milky = figures_of(crop(setup, kIrWidth, kIrHeight), LightModel::full);
  const double smear = milky.contrast / matte.contrast;
  print_figure("milky: contrast beside matte (fitted: scattering)", smear, 0.125 / 0.60, "measured",
               within_factor(0.125 / 0.60, 1.5));
  print_figure("       valid", milky.noise.valid, 0.51, "measured", within_factor(0.51, 1.5));
  print_figure("       temporal sigma [mm], mean", milky.noise.mean_mm, 3.5, "measured", within_factor(3.5, 1.5));
  print_note(
      "The plastic is not described: 0.5 scatterings per mm are fitted to its contrast, the matcher's least relative");
  print_note(
      "contrast, 0.26, to its valid share. Its deviation, matte faces, shadows and desks are predicted with both.");
}

void compare_black_mug() {
  print_title("Black glossy mug, 1.06 m away: share of its pixels with a depth");
  for (const double albedo : {0.01, 0.02, 0.03, 0.05}) {
    const Setup setup = crop(
        setup_from_json(Json::parse(fmt::format(
                            R"({{"sensor": {{"model": "kinect_v1_device", "height_mm": 400, "aim_mm": [0, 1000, 45]}},
        "cups": [{{"shape": {{"height_mm": 87, "bottom_mm": 5, "inner_radius_mm": 39, "outer_radius_mm": 42.5,
                              "albedo": {}}}, "position_mm": [0, 1000], "glaze": {{"roughness": 0.05}}}}]}})",
                            albedo)),
                        "mug"),
        kIrWidth, kIrHeight);
    Camera camera(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, 1);
    const Frame frame = camera.shoot(0);
    constexpr int kDesk = 1;
    double seen = 0.0, valid = 0.0;
    for (std::size_t i = 0; i < frame.depth.size(); ++i)
      if (camera.truth().pixels()[i].object > kDesk) ++seen, valid += frame.depth.pixels()[i] > 0.0f;
    print_figure(fmt::format("albedo {:g} below the glaze", albedo), valid / seen, 0.60, "measured");
  }
}

}  // namespace

void compare_materials() {
  compare_milky_plastic();
  compare_black_mug();
}

}  // namespace fathom
