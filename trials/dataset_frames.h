// The frames of a data set (datasets/scene_folder.h) as trials: from its depth images and labels alone, whoever made
// them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "trials/trial.h"

namespace fathom {

class DatasetFrames {
 public:
  /// One folder of frames.
  struct SceneFolder {
    std::string name;  ///< "000012"
    int frames;
  };

  /// Throws Error where the folder is no data set, or holds no folder that is complete.
  explicit DatasetFrames(std::filesystem::path folder);

  /// Those that are complete, by their names.
  const std::vector<SceneFolder>& scenes() const { return scenes_; }
  /// What notes all of a scene's files with their checksums.
  std::filesystem::path manifest_of(const SceneFolder& scene) const;

  /// `image` is the frame's place in the scene. Throws Error on files that are missing or say what cannot be.
  LabelledFrame read(const SceneFolder& scene, int image) const;

 private:
  std::filesystem::path folder_;
  std::vector<SceneFolder> scenes_;
  std::map<int, std::string> names_;  ///< of models
};

}  // namespace fathom
