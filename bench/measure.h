// How the tracing benchmarks are timed.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "bench/bench_scene.h"
#include "bench/embree_loop.h"

namespace fathom {

/// The scene in which tracing is measured, and Embree's own copy of it.
struct Yardstick {
  BenchScene scene{paper_water()};
  EmbreeLoop embree{scene.geometry};
};

/// Times what `run` does with its benchmark::State, by the whole process's processor time.
template <class Run>
auto* register_timed(const std::string& name, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(), std::move(run))
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

/// Times `work`; `counters` go beside the time.
template <class Work>
void measure(const std::string& name, const std::map<std::string, double>& counters, Work work) {
  register_timed(name, [counters, work](benchmark::State& state) {
    for (auto _ : state) work();
    for (const auto& [key, value] : counters) state.counters[key] = value;
  });
}

inline void measure_embree(const std::string& name, const std::shared_ptr<const EmbreeLoop>& embree,
                           Recording recording) {
  const auto shared = std::make_shared<const Recording>(std::move(recording));
  measure(name, {{"rays", static_cast<double>(shared->rays())}},
          [=] { benchmark::DoNotOptimize(embree->trace(*shared)); });
}

}  // namespace fathom
