// How the tracing benchmarks are timed.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>

#include "bench/embree_loop.h"

namespace fathom {

/// Times `work` by the whole process's processor time; `counters` go beside the time.
template <class Work>
void measure(const std::string& name, const std::map<std::string, double>& counters, Work work) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [counters, work](benchmark::State& state) {
                                 for (auto _ : state) work();
                                 for (const auto& [key, value] : counters) state.counters[key] = value;
                               })
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

inline void measure_embree(const std::string& name, const std::shared_ptr<const EmbreeLoop>& embree,
                           Recording recording) {
  const auto shared = std::make_shared<const Recording>(std::move(recording));
  measure(name, {{"rays", static_cast<double>(shared->rays())}},
          [=] { benchmark::DoNotOptimize(embree->trace(*shared)); });
}

}  // namespace fathom
