// usage: fathom_bench GROUP [Google Benchmark's options]
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>
#include <string_view>

#include "bench/benchmark_groups.h"
#include "core/memory.h"

namespace {

struct Group {
  std::string_view name;
  void (*register_benchmarks)();
  std::string_view summary;
};

constexpr std::array<Group, 7> kGroups{{
    {"geometric", fathom::register_geometric, "trace_truth() beside a bare Embree loop over the same rays"},
    {"photometric", fathom::register_photometric, "render_ir() beside a bare Embree loop"},
    {"light", fathom::register_light, "render_ir() with all light in clear, turbid and glass scenes, with its noise"},
    {"match", fathom::register_match, "match() beside OpenCV's StereoBM and StereoSGBM, one thread"},
    {"detect", fathom::register_detect,
     "the methods beside a pipeline of PCL's tutorials, one thread; FATHOM_REAL_DATA adds measured clouds"},
    {"generate", fathom::register_generate,
     "labelled frames of a data set beside a bare Embree loop, and a second thread"},
    {"others", fathom::register_others, "dots under water as POV-Ray and Blender's Cycles show them, beside ours"},
}};

int fail_with_usage() {
  fmt::print(stderr, "usage: fathom_bench GROUP [--benchmark_...]\n");
  for (const Group& group : kGroups) fmt::print(stderr, "  {:12} {}\n", group.name, group.summary);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  fathom::keep_freed_pages();
  const std::string_view asked = argc > 1 ? argv[1] : "";
  for (const Group& group : kGroups) {
    if (group.name != asked) continue;
    int rest = argc - 1;
    benchmark::Initialize(&rest, argv + 1);
    if (benchmark::ReportUnrecognizedArguments(rest, argv + 1)) return 2;
    try {
      group.register_benchmarks();
      benchmark::RunSpecifiedBenchmarks();
    } catch (const std::exception& error) {
      fmt::print(stderr, "error: {}\n", error.what());
      return 1;
    }
    return 0;
  }
  return fail_with_usage();
}
