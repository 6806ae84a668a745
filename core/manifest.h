// What a run has made so far, so that it can go on after it was killed: DIR/manifest.jsonl.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "core/json.h"

namespace fathom {

/// Everything that decides a run's bytes; the program itself is added.
struct RunIdentity {
  std::string command;
  Json options = Json::object();
  std::map<std::string, std::string> inputs = {};  ///< SHA-256 by path, as core/input_record.h has them
};

/// The first line of manifest.jsonl is the run's identity. It has inputs by their SHA-256 alone, without their names:
/// they may be moved, and the folder says nothing of what they hold. Every further line has the name of a whole file in
/// the folder, its size and its SHA-256. Lines are appended as files appear; one that a kill cut short does not count.
/// For the folder's owner (core/folder_owner.h).
class Manifest {
 public:
  /// Reads what the folder's manifest says, where there is one.
  Manifest(std::filesystem::path folder, const RunIdentity& identity);

  /// Whether the folder has a manifest, of any run.
  bool exists() const { return exists_; }
  /// What parts this run from the one whose manifest it is: "spec.json has changed". Nothing where they are the same,
  /// or where there is none.
  const std::optional<std::string>& difference() const { return difference_; }
  /// Throws Error when there is a difference, or when the folder has no manifest but one of these names: it is somebody
  /// else's.
  void require_same_run(std::span<const std::string> names = {}) const;
  /// The same where another run of this command may be written over.
  void require_same_command(std::span<const std::string> names) const;

  /// Notes no file any more, under the identity that stands there: the files of that run may go. A run that is killed
  /// before begin() finds another's manifest again.
  void forget_files() const;
  /// Writes the identity and the files that are noted so far: none, where there was a difference. Call before add().
  void begin();
  /// Whether this file was noted and stands in the folder with the same bytes.
  bool holds(const std::string& name) const;
  /// Notes a file that is whole. Threads may do so side by side.
  void add(const std::string& name);
  /// When the run is done: the lines in the order of their names, whichever way the run went.
  void finish();

 private:
  std::filesystem::path folder_, path_;
  Json identity_;
  bool exists_ = false, is_same_command_ = false;
  std::optional<std::string> difference_;
  std::map<std::string, Json> files_;
  std::ofstream appended_;
  std::mutex adding_;
};

}  // namespace fathom
