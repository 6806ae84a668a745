// What a labelled frame of a data set costs, beside Embree alone, and what a second thread gains.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <memory>
#include <string>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/embree_loop.h"
#include "bench/measure.h"
#include "bench/ray_recorder.h"
#include "core/files.h"
#include "datasets/scene_folder.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// A data set of the shipped specification in a folder of its own.
class Generated {
 public:
  Generated(const char* mode, const char* light, int frames) {
    write_text(folder_ / "spec.json", fmt::format(R"({{"mode": "{}", "light": "{}"}})", mode, light));
    dataset_ = std::make_unique<Dataset>(
        Dataset{.spec = read_dataset_spec(folder_ / "spec.json", kSeed), .seed = kSeed, .frames = frames});
  }

  /// All frames anew, with their labels gathered; in a new folder, because files that take the place of deleted ones
  /// cost the file system more.
  void make() {
    const fs::path frames = folder_ / fmt::format("frames_{}", made_++);
    make_directory(frames);
    write_scene(frames, *dataset_, 0, {"generate", {}}, [] {});
  }

  double bytes() const {
    double bytes = 0.0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "frames_0"))
      if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
    return bytes / dataset_->frames;
  }

 private:
  static constexpr std::uint64_t kSeed = 1;
  TemporaryFolder folder_;
  int made_ = 0;
  std::unique_ptr<Dataset> dataset_;
};

void measure_frames(const std::string& name, const char* mode, const char* light, int frames) {
  const auto generated = std::make_shared<Generated>(mode, light, frames);
  generated->make();
  measure(name, {{"frames", frames}, {"bytes", generated->bytes()}}, [generated] { generated->make(); });
}

/// The same work by one thread.
template <class Work>
void measure_alone(const std::string& name, double count, Work work) {
  measure(name, {{"rays", count}}, [work] {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    work();
  });
}

}  // namespace

void register_generate() {
  constexpr int kGeometric = 100, kPhotometric = 4;  // a whole scene, of which 24 frames have previews
  measure_frames("generate/geometric", "geometric", "direct", kGeometric);
  measure_frames("generate/geometric_scattered", "geometric", "auto", kGeometric);
  measure_frames("generate/photometric", "photometric", "direct", kPhotometric);
  const auto alone = std::make_shared<Generated>("geometric", "direct", kGeometric);
  measure_alone("generate/geometric_one_thread", 0.0, [alone] { alone->make(); });

  const auto yardstick = std::make_shared<const Yardstick>();
  Recording rays = record_camera_rays(yardstick->scene.world, yardstick->scene.setup.rig, kSamplesAcross);
  const auto shared = std::make_shared<const Recording>(rays);
  measure_alone("generate/embree_one_thread", static_cast<double>(rays.rays()),
                [yardstick, shared] { benchmark::DoNotOptimize(yardstick->embree.trace(*shared)); });
  measure_embree("generate/embree", {yardstick, &yardstick->embree}, std::move(rays));
}

}  // namespace fathom
