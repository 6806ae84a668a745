// The paper's method on one captured cloud, stage by stage.
#include <benchmark/benchmark.h>

#include <memory>
#include <stdexcept>

#include "bench/bench_scene.h"
#include "bench/groups.h"
#include "core/files.h"
#include "detector/paper.h"
#include "sim/sensor/capture.h"

namespace fathom {
namespace {

/// What each stage starts from.
struct Stages {
  Cloud cloud;
  DetectorSettings settings;
  DeskView view;
  Candidate cup;
};

Cloud captured_cloud() {
  Camera camera(paper_water(), CaptureMode::photometric, kDefaultSamplesPerPixel, 1);
  return cloud_from_image(camera.shoot(0).cloud);
}

Stages prepare_stages() {
  Stages stages;
  stages.cloud = captured_cloud();
  stages.settings.templates = load_templates(data_directory() / "templates");
  const PaperConfig& config = stages.settings.paper;
  stages.view = std::get<DeskView>(view_of_desk(stages.cloud, std::nullopt, config.plane));
  for (const Candidate& candidate : cup_candidates(stages.view, config))
    if (candidate.rejected.empty()) stages.cup = candidate;
  if (!stages.cup.circle) throw std::runtime_error("the paper's method finds no cup to measure in the captured cloud");
  return stages;
}

template <class Work>
void measure(const char* name, Work work) {
  benchmark::RegisterBenchmark(name,
                               [work](benchmark::State& state) {
                                 for (auto _ : state) benchmark::DoNotOptimize(work());
                               })
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_detect() {
  const auto stages = std::make_shared<const Stages>(prepare_stages());
  const DetectorSettings& settings = stages->settings;
  const PaperConfig& config = settings.paper;
  measure("detect/desk", [stages, &config] { return view_of_desk(stages->cloud, std::nullopt, config.plane); });
  measure("detect/segments", [stages, &config] { return cup_candidates(stages->view, config); });
  measure("detect/icp",
          [stages, &settings] { return match_templates(stages->cup, settings.templates, settings.paper.icp); });
  measure("detect/inside",
          [stages, &config] { return interior_height(stages->view.points, *stages->cup.circle, config.interior); });
  measure("detect/whole", [stages, &settings] { return detect_paper(stages->cloud, settings); });
}

}  // namespace fathom
