// How much tracing costs beyond what Embree itself needs for the same rays.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/embree_loop.h"
#include "bench/measure.h"
#include "bench/ray_recorder.h"
#include "sim/render/truth.h"
#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

std::shared_ptr<const EmbreeLoop> embree_of(const std::shared_ptr<const Yardstick>& yardstick) {
  return {yardstick, &yardstick->embree};
}

/// The loop must find what the capture found, or it is no yardstick. A refracted ray's direction is rounded anew, so a
/// ray in 10 000 may fall on the other side of an edge.
void require_same_hits(const Yardstick& yardstick, const Recording& recording) {
  const double hits = static_cast<double>(yardstick.embree.trace(recording));
  if (std::fabs(hits - static_cast<double>(recording.hits)) > 1e-4 * static_cast<double>(recording.rays()))
    throw std::runtime_error("the bare Embree loop hits other surfaces than the capture");
}

}  // namespace

void register_geometric() {
  const auto yardstick = std::make_shared<const Yardstick>();
  const BenchScene& scene = yardstick->scene;
  Recording recording = record_truth(scene.world, scene.setup.rig);
  require_same_hits(*yardstick, recording);
  measure("geometric/fathom", {{"rays", static_cast<double>(recording.rays())}},
          [yardstick, &scene] { benchmark::DoNotOptimize(trace_truth(scene.projector, scene.setup.rig)); });
  measure_embree("geometric/embree", embree_of(yardstick), std::move(recording));
}

void register_photometric() {
  const auto yardstick = std::make_shared<const Yardstick>();
  const BenchScene& scene = yardstick->scene;
  const SensorModel& sensor = scene.setup.rig.sensor;
  const auto pattern = std::make_shared<Pattern>(sensor.pattern, sensor.ir_scale());
  pattern->set_dot_gains(speckle_gains(sensor.noise, *pattern, 1));

  Recording recording = record_render(scene.world, scene.setup.rig, kSamplesAcross);
  require_same_hits(*yardstick, recording);
  measure("photometric/fathom", {{"rays", static_cast<double>(recording.rays())}}, [yardstick, &scene, pattern] {
    benchmark::DoNotOptimize(
        render_ir(scene.projector, scene.setup.rig, *pattern, kSamplesAcross, LightModel::direct, 1));
  });
  measure_embree("photometric/embree", embree_of(yardstick), std::move(recording));
}

}  // namespace fathom
