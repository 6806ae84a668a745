#include "core/folder_owner.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/files.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// What the owner wrote into its lock; it may have locked the file and not yet written.
std::string words_of(int descriptor) {
  std::array<char, 512> words;
  const ssize_t size = ::pread(descriptor, words.data(), words.size(), 0);
  return size > 0 ? std::string(words.data(), static_cast<std::size_t>(size)) : "another process";
}

/// An owner that is done removes its file, so that the one locked here may be no longer the folder's.
bool is_file_of(int descriptor, const fs::path& path) {
  struct stat locked, standing;
  return ::fstat(descriptor, &locked) == 0 && ::stat(path.c_str(), &standing) == 0 &&
         locked.st_dev == standing.st_dev && locked.st_ino == standing.st_ino;
}

/// The lock file, opened; negative where its folder is no more.
int open_lock(const fs::path& file, bool folder_may_vanish) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor < 0 && !(errno == ENOENT && folder_may_vanish))
    throw Error(file.string(), fmt::format("cannot be created: {}", std::strerror(errno)));
  return descriptor;
}

}  // namespace

FolderOwner::FolderOwner(fs::path folder, std::chrono::seconds patience)
    : folder_(std::move(folder)), file_(folder_ / ".fathom.lock") {
  const auto end = std::chrono::steady_clock::now() + patience;
  // Between the two calls an owner that wrote nothing may remove the folder: try again. The limit is for /proc, where
  // creating never succeeds.
  constexpr int kAttempts = 1000;
  for (int attempt = 1; descriptor_ < 0; ++attempt) {
    is_new_ = !fs::exists(folder_);
    make_directory(folder_);
    const int descriptor = open_lock(file_, attempt < kAttempts);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      if (is_file_of(descriptor, file_))
        descriptor_ = descriptor;
      else
        ::close(descriptor);
      continue;
    }
    const int problem = errno;
    const std::string owner = words_of(descriptor);
    ::close(descriptor);
    if (problem == EWOULDBLOCK && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      attempt = 0;
      continue;
    }
    if (problem == EWOULDBLOCK)
      throw Error(folder_.string(), fmt::format("is being written by {}; wait for it or choose another folder", owner));
    throw Error(file_.string(), fmt::format("cannot be locked: {}", std::strerror(problem)));
  }
  const std::string words = fmt::format("process {} on {}", ::getpid(), host_name());
  const bool named = ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, words.data(), words.size(), 0) > 0;
  static_cast<void>(named);  // on a full disk others are told of a process without a name
  remove_leftovers(folder_);
}

FolderOwner::~FolderOwner() {
  ::unlink(file_.c_str());  // before the lock goes, so that nobody's new file is taken away
  ::close(descriptor_);
  std::error_code holds_files;
  if (is_new_) fs::remove(folder_, holds_files);
}

}  // namespace fathom
