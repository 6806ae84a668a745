// All the light of one infrared image: what it costs, and how much of its walks' chance is left in it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/embree_loop.h"
#include "bench/measure.h"
#include "bench/ray_recorder.h"
#include "core/files.h"
#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

struct Case {
  BenchScene scene;
  Pattern pattern;
  EmbreeLoop embree;

  explicit Case(const std::string& file)
      : scene(read_setup(data_directory() / file)), pattern(with_speckle(1)), embree(scene.geometry) {}

  Pattern with_speckle(std::uint64_t seed) const {
    const SensorModel& sensor = scene.setup.rig.sensor;
    Pattern result(sensor.pattern, sensor.ir_scale());
    result.set_dot_gains(speckle_gains(sensor.noise, result, seed));
    return result;
  }

  Image<float> image(const Pattern& of_projector, std::uint64_t seed) const {
    return render_ir(scene.projector, scene.setup.rig, of_projector, kSamplesAcross, LightModel::full, seed);
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
  for (const char* name : {"paper_water", "meniscus_water", "paper_milk_tea", "glass_water"}) {
    const auto measured = std::make_shared<const Case>(fmt::format("{}.json", name));
    const Noise noise = noise_of(*measured);
    measure(fmt::format("light/{}/fathom", name), {{"walks_dn", noise.of_walks}, {"sensor_dn", noise.of_sensor}},
            [measured] { benchmark::DoNotOptimize(measured->image(measured->pattern, 1)); });
    measure_embree(fmt::format("light/{}/embree", name), {measured, &measured->embree},
                   record_camera_rays(measured->scene.world, measured->scene.setup.rig, kSamplesAcross));
  }
}

}  // namespace fathom
