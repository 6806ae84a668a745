#include "core/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <regex>
#include <vector>

#include "core/error.h"
#include "core/input_policy.h"
#include "core/input_record.h"

namespace fathom {
namespace fs = std::filesystem;

namespace {

/// By fsync or syncfs.
void flush_to_disk(const fs::path& path, int (*flush)(int)) {
  const int file = ::open(path.c_str(), O_RDONLY);
  if (file < 0) throw Error(path.string(), std::strerror(errno));
  const bool flushed = flush(file) == 0 || errno == EINVAL;  // EINVAL: a file system without it
  ::close(file);
  if (!flushed) throw Error(path.string(), "cannot be flushed to disk");
}

/// ".NAME.PID.fathom.part.EXTENSION": the extension stays last, because some writers choose their format by it.
std::string name_beside(const fs::path& path) {
  return fmt::format(".{}.{}.fathom.part{}", path.stem().string(), ::getpid(), path.extension().string());
}

/// Whether the file was being written by a process of this program that is no more. One of this process' own number was
/// left by another that had it before.
bool is_leftover(const fs::path& path) {
  static const std::regex pattern(R"(\..*\.(\d{1,9})\.fathom\.part(\.[^.]*)?)");
  std::smatch parts;
  const std::string name = path.filename().string();
  if (!std::regex_match(name, parts, pattern)) return false;
  const pid_t writer = std::stoi(parts[1]);
  return writer == ::getpid() || (::kill(writer, 0) != 0 && errno == ESRCH);
}

struct OpenFile {
  int descriptor;

  explicit OpenFile(int opened) : descriptor(opened) {}
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
};

void require_regular(const std::string& name, const struct ::stat& about) {
  if (S_ISDIR(about.st_mode)) throw Error(name, "is a folder, expected a file");
  if (!S_ISREG(about.st_mode)) throw Error(name, "is no regular file (a pipe, a socket or a device)");
}

}  // namespace

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write, Flush flush) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) throw Error(path.string(), "cannot be written: its folder does not exist");
  if (fs::is_directory(path)) throw Error(path.string(), "cannot be written: a folder of that name exists");
  const fs::path beside = folder / name_beside(path);
  try {
    write(beside);
    if (flush == Flush::at_once) flush_to_disk(beside, ::fsync);
    fs::rename(beside, path);
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw;
  } catch (const std::exception& problem) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw Error(path.string(), std::string("cannot be written: ") + problem.what());
  }
}

void flush_file_system(const fs::path& folder) { flush_to_disk(folder, ::syncfs); }

void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;  // what cannot be removed does no harm
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_leftover(entry.path())) leftovers.push_back(entry.path());
  for (const fs::path& leftover : leftovers) fs::remove(leftover, ignored);
}

void write_text(const fs::path& path, std::string_view text, Flush flush) {
  const auto write = [&](const fs::path& beside) {
    std::ofstream file(beside, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) throw Error(path.string(), "cannot be written");
  };
  write_atomically(path, write, flush);
}

std::string read_text(const fs::path& path) {
  const std::string name = path.string();
  struct ::stat about {};
  // Before opening, too: to open a device may do something, to open a pipe may wait for its writer.
  if (::stat(path.c_str(), &about) != 0)
    throw Error(name, errno == ENOENT ? "no such file" : fmt::format("cannot be read: {}", std::strerror(errno)));
  require_regular(name, about);
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.descriptor < 0 || ::fstat(file.descriptor, &about) != 0)
    throw Error(name, fmt::format("cannot be read: {}", std::strerror(errno)));
  require_regular(name, about);
  require_within_limit(name, "", static_cast<std::uint64_t>(about.st_size), "content");
  // One byte more than there should be, to see the end. Files in /proc and /sys report size 0 but have content.
  std::string text(static_cast<std::size_t>(about.st_size) + 1, '\0');
  for (std::size_t had = 0;;) {
    constexpr std::size_t kMore = 1 << 16;
    if (had == text.size()) text.resize(had + std::max(kMore, had / 2));
    const ::ssize_t got = ::read(file.descriptor, text.data() + had, text.size() - had);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(name, fmt::format("cannot be read: {}", std::strerror(errno)));
    had += static_cast<std::size_t>(got);
    require_within_limit(name, "", had, "content");
    if (got > 0) continue;
    text.resize(had);
    record_input(path, text);
    return text;
  }
}

void make_directory(const fs::path& path) {
  std::error_code problem;
  fs::create_directories(path, problem);
  if (problem || !fs::is_directory(path)) throw Error(path.string(), "cannot be created as a folder");
}

fs::path data_directory() {
  if (const char* named = std::getenv("FATHOM_DATA")) {
    if (fs::is_directory(fs::path(named) / "templates")) return named;
    throw Error(named, "FATHOM_DATA: holds no templates/, expected the folder scenes/ of Fathom");
  }
  for (const char* candidate : {FATHOM_INSTALLED_DATA, FATHOM_SOURCE_DATA})
    if (fs::is_directory(fs::path(candidate) / "templates")) return candidate;
  throw Error(FATHOM_INSTALLED_DATA, "the libraries of cups, media and sensors are missing; set FATHOM_DATA");
}

bool is_ours(const std::filesystem::path& file, std::string_view words) {
  if (!std::filesystem::is_regular_file(file)) return false;
  std::string head(1000, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(words) != std::string::npos;
}

void remove_if_ours(const std::filesystem::path& file, std::string_view words) {
  if (is_ours(file, words)) std::filesystem::remove(file);
}

}  // namespace fathom
