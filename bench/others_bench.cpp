// Dots on the bottom under water: error and time beside other renderers that can show them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/dot_error.h"
#include "bench/measure.h"
#include "bench/other_renderers.h"

namespace fathom {
namespace {

struct Yardstick {
  SparseDots dots{200.0, 0.0};  // Cycles' shadow caustics know no absorption
  EmbreeLoop embree{dots.view().geometry};
};

std::map<std::string, double> counters_of(const DotError& error, double effort) {
  return {{"effort", effort},
          {"dots", error.dots},
          {"place_ir_px", error.place_ir_px},
          {"brightness", error.brightness},
          {"rmse", error.rmse}};
}

/// Runs another program once. Its times are not those of this process, and become counters.
void measure_other(const std::string& name, const std::shared_ptr<const Yardstick>& yardstick, int effort,
                   Rendering (*render)(const SparseDots&, int)) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    for (auto _ : state) {
      const Rendering rendering = render(yardstick->dots, effort);
      for (const auto& [key, value] : counters_of(dot_error(yardstick->dots, rendering.image), effort))
        state.counters[key] = value;
      state.counters["cpu_s"] = rendering.cpu_s;
      state.counters["wall_s"] = rendering.wall_s;
    }
  })->Iterations(1);
}

bool is_there(const std::string& program) {
  const bool there = is_installed(program);
  if (!there) fmt::print(stderr, "{} is not installed and is left out\n", program);
  return there;
}

}  // namespace

void register_others() {
  const auto yardstick = std::make_shared<const Yardstick>();
  for (const int across : {1, 2, 3, 4})
    measure(fmt::format("others/fathom/{}", across * across),
            counters_of(dot_error(yardstick->dots, yardstick->dots.image(across)), across * across),
            [yardstick, across] { benchmark::DoNotOptimize(yardstick->dots.image(across)); });
  measure_embree("others/embree", {yardstick, &yardstick->embree},
                 record_camera_rays(yardstick->dots.view().world, yardstick->dots.view().rig, kSamplesAcross));
  if (is_there("povray"))
    for (const int photons : {30'000, 100'000, 300'000, 1'000'000, 3'000'000})
      measure_other(fmt::format("others/povray/{}", photons), yardstick, photons, render_with_povray);
  if (is_there("blender"))
    for (const int samples : {16, 64, 256})
      measure_other(fmt::format("others/cycles/{}", samples), yardstick, samples, render_with_cycles);
}

}  // namespace fathom
