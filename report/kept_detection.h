// The folder of a detection: what was found as JSON, and the clouds in which it was found, for `fathom view`.
#pragma once

#include <filesystem>

#include "core/folder_owner.h"
#include "core/json.h"
#include "detector/cloud.h"

namespace fathom {

inline constexpr const char* kDetectionFile = "detection.json";

/// Where the cloud of that number lies, if it was kept.
std::filesystem::path kept_cloud(const std::filesystem::path& folder, int number);

/// A detection that is being written. The folder is this process's while the object lives.
class KeptDetection {
 public:
  /// `clouds`: how many are kept at most.
  KeptDetection(std::filesystem::path folder, int clouds);

  /// With the first an older detection no longer counts.
  void add(const Cloud& cloud);
  /// Writes detection.txt, where there are rows, and detection.json: its presence says that the detection is whole. An
  /// older one's clouds are gone then.
  void finish(const Json& detection, std::string_view rows) const;

 private:
  std::filesystem::path folder_;
  FolderOwner owner_;
  int clouds_, added_ = 0;
};

}  // namespace fathom
