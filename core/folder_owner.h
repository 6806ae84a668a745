// One folder is written by one process at a time.
#pragma once

#include <chrono>
#include <filesystem>

namespace fathom {

/// Makes the folder and owns it while this object lives. The lock is the kernel's (flock on DIR/.fathom.lock), so that
/// a process that is killed gives it up, and the file that a killed process leaves behind locks nobody out. What killed
/// processes left half written in the folder is removed. A folder that was made here and into which nothing was written
/// disappears again. Throws Error that names the owner when there is one after `patience`, or when the folder cannot be
/// made or locked.
class FolderOwner {
 public:
  explicit FolderOwner(std::filesystem::path folder, std::chrono::seconds patience = std::chrono::seconds(0));
  ~FolderOwner();
  FolderOwner(const FolderOwner&) = delete;
  FolderOwner& operator=(const FolderOwner&) = delete;

 private:
  std::filesystem::path folder_, file_;
  bool is_new_ = false;
  int descriptor_ = -1;
};

}  // namespace fathom
