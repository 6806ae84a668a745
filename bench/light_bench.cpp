// All the light of one infrared image: what it costs, and how much of its walks' chance is left in it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/embree_loop.h"
#include "bench/measure.h"
#include "bench/ray_recorder.h"
#include "core/files.h"
#include "core/json.h"
#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

struct Case {
  BenchScene scene;
  Pattern pattern;
  EmbreeLoop embree;

  explicit Case(const Setup& setup) : scene(setup), pattern(with_speckle(1)), embree(scene.geometry) {}

  Pattern with_speckle(std::uint64_t seed) const {
    const SensorModel& sensor = scene.setup.rig.sensor;
    Pattern result(sensor.pattern, sensor.ir_scale());
    result.set_dot_gains(speckle_gains(sensor.noise, result, seed));
    return result;
  }

  Image<float> image(const Pattern& of_projector, std::uint64_t seed) const {
    return render_ir(scene.projector, scene.setup.rig, of_projector, kSamplesAcross, LightModel::full, seed).projected;
  }
};

/// Root mean squares [DN] over the pixels that see a cup or a liquid.
struct Noise {
  double of_walks;   ///< what another seed of the walks changes, as the deviation of one image
  double of_sensor;  ///< the same for another speckle, and shot noise, read noise and rounding from the sensor's model
};

Noise noise_of(const Case& measured) {
  const Rig& rig = measured.scene.setup.rig;
  const NoiseModel& model = rig.sensor.noise;
  const Image<float> image = measured.image(measured.pattern, 1), other_walks = measured.image(measured.pattern, 2),
                     other_speckle = measured.image(measured.with_speckle(2), 1);
  const std::vector<Eigen::Vector2i> pixels = pixels_on_cups(measured.scene.projector, rig);
  double walks = 0.0, sensor = 0.0;
  for (const Eigen::Vector2i& at : pixels) {
    const double value = image(at.x(), at.y());
    walks += 0.5 * std::pow(value - other_walks(at.x(), at.y()), 2);
    sensor += 0.5 * std::pow(value - other_speckle(at.x(), at.y()), 2) + value / model.electrons_per_dn +
              model.read_dn * model.read_dn + 1.0 / 12.0;
  }
  const double count = static_cast<double>(pixels.size());
  return {std::sqrt(walks / count), std::sqrt(sensor / count)};
}

}  // namespace

void register_light() {
  struct Subject {
    const char* name;
    const char* file;
    const char* liquid;  ///< that takes the place of the file's; nullptr: none
  };
  constexpr std::array kSubjects{Subject{"paper_water", "paper_water.json", nullptr},
                                 Subject{"barley_tea", "paper_water.json", "barley_tea"},
                                 Subject{"meniscus_water", "meniscus_water.json", nullptr},
                                 Subject{"paper_milk_tea", "paper_milk_tea.json", nullptr},
                                 Subject{"orange_juice", "paper_milk_tea.json", "orange_juice"},
                                 Subject{"tomato_juice", "paper_milk_tea.json", "tomato_juice"},
                                 Subject{"whole_milk", "paper_milk_tea.json", "whole_milk"},
                                 Subject{"glass_water", "glass_water.json", nullptr}};
  for (const auto& [name, file, liquid] : kSubjects) {
    const std::filesystem::path path = data_directory() / file;
    Json json = read_json(path);
    if (liquid) json.at("cups").at(0)["liquid"] = liquid;
    const auto measured = std::make_shared<const Case>(setup_from_json(json, path.string()));
    const Noise noise = noise_of(*measured);
    measure(fmt::format("light/{}/fathom", name), {{"walks_dn", noise.of_walks}, {"sensor_dn", noise.of_sensor}},
            [measured] { benchmark::DoNotOptimize(measured->image(measured->pattern, 1)); });
    measure_embree(fmt::format("light/{}/embree", name), {measured, &measured->embree},
                   record_camera_rays(measured->scene.world, measured->scene.setup.rig, kSamplesAcross));
  }
}

}  // namespace fathom
