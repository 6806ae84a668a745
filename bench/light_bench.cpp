// All the light of one infrared image: what it costs, and how much of its walks' chance is left in it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "bench/bench_scene.h"
#include "bench/embree_loop.h"
#include "bench/groups.h"
#include "bench/measure.h"
#include "bench/ray_recorder.h"
#include "core/files.h"
#include "sim/render/truth.h"
#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

struct Case {
  BenchScene scene;
  Pattern pattern;
  EmbreeLoop embree;

  explicit Case(const std::string& file)
      : scene(read_setup(data_directory() / file)),
        pattern(scene.setup.rig.sensor.pattern, scene.setup.rig.sensor.ir_scale()),
        embree(scene.geometry) {}

  Image<float> image(std::uint64_t seed) const {
    return render_ir(scene.projector, scene.setup.rig, pattern, kSamplesAcross, LightModel::full, seed);
  }
};

/// Root mean squares [DN] over the pixels that see a cup or a liquid.
struct Noise {
  double of_walks;     ///< what another seed changes, as the deviation of one image
  double of_detector;  ///< shot, read and rounding, from the sensor's model
};

Noise noise_of(const Case& measured) {
  const Rig& rig = measured.scene.setup.rig;
  const NoiseModel& model = rig.sensor.noise;
  const Image<float> a = measured.image(1), b = measured.image(2);
  const Image<TruePixel> truth = trace_truth(measured.scene.projector, rig);
  double walks = 0.0, detector = 0.0;
  int pixels = 0;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x) {
      constexpr int kDesk = 1;
      if (truth(x, y).object <= kDesk) continue;
      const int ir_x = 2 * x, ir_y = 2 * y + rig.sensor.ir_first_row();
      const double value = 0.5 * (a(ir_x, ir_y) + b(ir_x, ir_y)), difference = a(ir_x, ir_y) - b(ir_x, ir_y);
      walks += 0.5 * difference * difference;
      detector += value / model.electrons_per_dn + model.read_dn * model.read_dn + 1.0 / 12.0;
      ++pixels;
    }
  return {std::sqrt(walks / pixels), std::sqrt(detector / pixels)};
}

}  // namespace

void register_light() {
  for (const char* name : {"paper_water", "meniscus_water", "paper_milk_tea", "glass_water"}) {
    const auto measured = std::make_shared<const Case>(fmt::format("{}.json", name));
    const Noise noise = noise_of(*measured);
    const Recording rays = record_camera_rays(measured->scene.world, measured->scene.setup.rig, kSamplesAcross);
    measure(fmt::format("light/{}/fathom", name), {{"walks_dn", noise.of_walks}, {"detector_dn", noise.of_detector}},
            [measured] { benchmark::DoNotOptimize(measured->image(1)); });
    measure_embree(fmt::format("light/{}/embree", name), {measured, &measured->embree},
                   record_camera_rays(measured->scene.world, measured->scene.setup.rig, kSamplesAcross));
  }
}

}  // namespace fathom
