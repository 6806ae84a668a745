#include "datasets/generate.h"

#include <algorithm>

#include "core/folder_owner.h"
#include "core/input_record.h"
#include "core/progress.h"

namespace fathom {
namespace {

/// Where a specification asks for more things than have room, the first frames say so before a folder is made.
void try_scenes(const Dataset& dataset) {
  constexpr int kTried = 50;
  for (int frame = 0; frame < std::min(dataset.frames, kTried); ++frame)
    dataset_scene(dataset.spec, dataset.seed, frame);
}

}  // namespace

DatasetRun dataset_run(const std::function<DatasetSpec()>& read, std::uint64_t seed, int frames) {
  const InputRecord inputs;  // ends before frames are made, which would note every file of theirs
  DatasetRun run{.dataset = {.spec = read(), .seed = seed, .frames = frames},
                 .identity = {"generate", {{"seed", seed}}}};
  try_scenes(run.dataset);
  run.identity.inputs = inputs.files();
  return run;
}

ShardFrames frames_of(const std::filesystem::path& folder, const Dataset& dataset, const Shard& shard) {
  ShardFrames frames;
  for (int scene = shard.number; scene < dataset.scenes(); scene += shard.count) {
    frames.all += dataset.frames_in(scene);
    frames.missing += missing_frames(folder, dataset, scene);
  }
  return frames;
}

MadeFrames make_frames(const std::filesystem::path& folder, const DatasetRun& run, const Shard& shard, bool quiet) {
  const Dataset& dataset = run.dataset;
  MadeFrames made{.frames = frames_of(folder, dataset, shard).all};
  // Shards share the folder: each owns it while it begins and ends, and in between its own scenes.
  {
    const FolderOwner owner(folder, kShardPatience);
    write_common(folder, dataset, run.identity);
  }
  Progress progress("frame", made.frames, quiet);
  for (int scene = shard.number; scene < dataset.scenes(); scene += shard.count)
    made.made_now += write_scene(folder, dataset, scene, run.identity, [&] { progress.step(); });
  const FolderOwner owner(folder, kShardPatience);
  made.complete = is_complete(folder, dataset);
  if (made.complete) write_dataset_page(folder, dataset);
  return made;
}

}  // namespace fathom
