// The methods on a captured, a cluttered and, where FATHOM_REAL_DATA names them, measured clouds, beside what one
// builds of PCL by its tutorials. All on one thread.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/measure.h"
#include "bench/pcl_pipeline.h"
#include "core/files.h"
#include "detector/detector.h"
#include "detector/read_cloud.h"
#include "sim/sensor/capture.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

Cloud captured_cloud() {
  Camera camera(paper_water(), CaptureMode::photometric, kDefaultSamplesPerPixel, 1);
  return cloud_from_image(camera.shoot(0).cloud);
}

/// Three cups among five boxes, two of them touching, with a millimetre of noise.
Cloud cluttered_cloud() {
  synthetic::Scene scene;
  scene.width = 640, scene.height = 480, scene.focal_px = 570.342, scene.noise_m = 0.001;
  const auto cup = [](double x_m, double y_m) {
    synthetic::OpenCup one;
    one.x_m = x_m, one.y_m = y_m;
    return one;
  };
  scene.cups = {cup(-0.043, 0.40), cup(0.043, 0.40), cup(0.20, 0.35)};
  scene.boxes = {{{-0.30, 0.30}, {-0.20, 0.40}, 0.09},
                 {{-0.20, 0.55}, {0.05, 0.62}, 0.10},
                 {{0.12, 0.50}, {0.26, 0.60}, 0.08},
                 {{-0.15, 0.20}, {-0.05, 0.28}, 0.05},
                 {{0.05, 0.20}, {0.20, 0.26}, 0.06}};
  return synthetic::cast(scene);
}

void add_cloud(const std::string& name, Cloud cloud, const std::shared_ptr<const DetectorSettings>& settings) {
  const auto shared = std::make_shared<const Cloud>(std::move(cloud));
  const auto add = [&](std::string_view side, auto work) {
    return register_timed(fmt::format("detect/{}/{}", name, side), [work](benchmark::State& state) {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      for (auto _ : state) benchmark::DoNotOptimize(work());
    });
  };
  for (const char* name_of_method : {"robust", "paper", "sac-ia"}) {
    const Method& method = method_named(name_of_method);
    auto* timed = add(method.name, [shared, settings, &method] { return method.detect(*shared, *settings); });
    if (method.name == "sac-ia") timed->Iterations(1)->Repetitions(1);  // takes seconds
  }
  add("pcl", [shared, settings] { return pcl_pipeline(*shared, settings->templates); });
}

}  // namespace

void register_detect() {
  auto settings = std::make_shared<DetectorSettings>();
  settings->templates = load_templates(data_directory() / "templates");
  add_cloud("captured", captured_cloud(), settings);
  add_cloud("clutter", cluttered_cloud(), settings);
  const char* measured = std::getenv("FATHOM_REAL_DATA");
  if (!measured) return;
  for (const char* scene : {"learn33", "learn38", "learn44"})
    add_cloud(scene, read_cloud(std::filesystem::path(measured) / "mOSD" / (std::string(scene) + ".pcd")), settings);
}

}  // namespace fathom
