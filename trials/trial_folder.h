// The folder of an evaluation on random desks: what a second run goes on with, and what failed.
#pragma once

#include <optional>
#include <string>

#include "core/folder_owner.h"
#include "core/manifest.h"
#include "trials/clutter_trial.h"

namespace fathom {

class TrialFolder {
 public:
  /// Takes the folder for this evaluation. Throws Error when it is another's, or when trials of unknown origin are
  /// there.
  TrialFolder(const std::filesystem::path& folder, const RunIdentity& identity);

  /// A trial that an earlier run kept, as it was written.
  std::optional<TrialResult> kept(const std::string& name) const;

  /// Keeps a trial in trials/, and of one that failed its scene and its picture in failures/.
  void keep(const std::string& name, const Json& scene, const TrialShot& shot, const Trial& trial);

  /// All trials are there.
  void finish() { manifest_.finish(); }

 private:
  std::filesystem::path folder_;
  FolderOwner owner_;
  Manifest manifest_;
};

}  // namespace fathom
