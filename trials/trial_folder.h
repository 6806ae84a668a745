// The trials of an evaluation in a folder: what a second run goes on with.
#pragma once

#include <optional>
#include <string>

#include "core/folder_owner.h"
#include "core/manifest.h"
#include "trials/trial.h"

namespace fathom {

/// FOLDER/trials/NAME.json
std::filesystem::path trial_file(const std::filesystem::path& folder, const std::string& name);

class TrialFolder {
 public:
  /// Takes the folder for this evaluation. Throws Error when it is another's, or when trials of unknown origin are
  /// there.
  TrialFolder(const std::filesystem::path& folder, const RunIdentity& identity);

  /// A trial that an earlier run kept, as it was written.
  std::optional<TrialResult> kept(const std::string& name) const;

  /// Keeps a trial in trials/. Any thread may say so.
  void keep(const std::string& name, const TrialResult& result);

  /// All trials are there.
  void finish() { manifest_.finish(); }

 private:
  std::filesystem::path folder_;
  FolderOwner owner_;
  Manifest manifest_;
};

}  // namespace fathom
