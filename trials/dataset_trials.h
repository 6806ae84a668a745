// A data set searched by a detector, scene by scene: by one process or by many that share the folder of answers.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/manifest.h"
#include "trials/dataset_frames.h"

namespace fathom {

/// Throws Error where FOLDER/scenes/NAME holds another evaluation's answers. Also while another process writes there.
void require_same_evaluation(const std::filesystem::path& folder, const DatasetFrames& frames,
                             const DatasetFrames::SceneFolder& scene, const RunIdentity& identity);

/// Searches those frames of a scene that FOLDER/scenes/NAME does not hold yet, on all threads, and calls `step` for
/// each frame from any of them. Times are left out, so that the same frames give the same bytes. Throws Error where
/// another evaluation's answers are there.
void search_scene(const std::filesystem::path& folder, const DatasetFrames& frames,
                  const DatasetFrames::SceneFolder& scene, const RunIdentity& identity, const Method& method,
                  const DetectorSettings& settings, const std::function<void()>& step);

/// The answers to all frames of the scenes, by their names "000012_000017"; nothing where some are missing.
std::optional<std::vector<TrialResult>> searched(const std::filesystem::path& folder, const DatasetFrames& frames);

/// Writes pictures of the first failures of each kind to FOLDER/failures, and returns these trials.
std::vector<TrialResult> picture_failures(const std::filesystem::path& folder, const DatasetFrames& frames,
                                          const std::vector<TrialResult>& trials, const Method& method,
                                          const DetectorSettings& settings);

}  // namespace fathom
