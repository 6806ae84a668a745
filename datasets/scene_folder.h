// A data set on disk: folders of a hundred frames in BOP's layout, each with COCO's annotations, that grow frame by
// frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/manifest.h"
#include "datasets/dataset_spec.h"
#include "datasets/model.h"

namespace fathom {

inline constexpr int kPreviews = 24;  ///< of a data set's first frames

/// Everything that decides the frames.
struct Dataset {
  DatasetSpec spec;
  std::uint64_t seed;
  int frames;
  int frames_of_scene = 100;  ///< of one folder
  Models models{spec.clutter};

  int scenes() const { return (frames + frames_of_scene - 1) / frames_of_scene; }
  int frames_in(int scene) const { return std::min(frames_of_scene, frames - scene * frames_of_scene); }
};

/// "train/000012"
std::string scene_folder(int scene);

/// Writes what all frames have in common: dataset.json, models/, camera.json, as far as they are not there. For the
/// folder's owner. Throws Error, before anything is written, where what stands there is another run's.
void write_common(const std::filesystem::path& folder, const Dataset& dataset, const RunIdentity& identity);

/// How many of a scene's frames are not there yet, by their labels.
int missing_frames(const std::filesystem::path& folder, const Dataset& dataset, int scene);

/// Makes the frames of a scene's folder that are not there yet, or not as they were written, and then the files that
/// gather their labels. Calls `step` for every frame, from any thread; returns how many were made now. The folder is
/// this process's meanwhile. Throws Error where another data set's frames are there.
int write_scene(const std::filesystem::path& folder, const Dataset& dataset, int scene, const RunIdentity& identity,
                const std::function<void()>& step);

/// Whether every scene's labels are gathered, of all its frames.
bool is_complete(const std::filesystem::path& folder, const Dataset& dataset);

/// For people: index.html beside the frames, of a data set that is complete. Thumbnails of its first frames, and
/// histograms of cups a frame, liquids, fills, shares that are in sight, distances and heights of the sensor.
void write_dataset_page(const std::filesystem::path& folder, const Dataset& dataset);

}  // namespace fathom
