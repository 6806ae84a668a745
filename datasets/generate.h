// The making of a data set, or of one process's part of it.
#pragma once

#include <chrono>
#include <functional>

#include "datasets/scene_folder.h"

namespace fathom {

/// The `number`-th of `count` parts, from 0: every count-th scene.
struct Shard {
  int number = 0, count = 1;
};

/// How long a process waits for the folder that all of them share.
inline constexpr std::chrono::seconds kShardPatience(600);

/// A data set, and what it was read from.
struct DatasetRun {
  Dataset dataset;
  RunIdentity identity;
};

/// Calls `read` for the specification and notes the files that it reads. Throws Error where it does, and where one of
/// the first frames asks for more things than have room.
DatasetRun dataset_run(const std::function<DatasetSpec()>& read, std::uint64_t seed, int frames);

struct ShardFrames {
  int all = 0, missing = 0;
};
ShardFrames frames_of(const std::filesystem::path& folder, const Dataset& dataset, const Shard& shard);

struct MadeFrames {
  int frames = 0, made_now = 0;  ///< of the shard
  bool complete = false;         ///< with those of all others; only then there is a page
};

/// Makes the frames of a shard that are not there yet; whoever completes the data set writes its page. Shards may be
/// made at once, by processes that share the folder. Tells of its progress unless `quiet`. Throws Error where the
/// folder is another run's or cannot be written.
MadeFrames make_frames(const std::filesystem::path& folder, const DatasetRun& run, const Shard& shard, bool quiet);

}  // namespace fathom
