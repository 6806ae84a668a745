// What a run was made from: the files that it read, by their contents.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace fathom {

/// While one lives, every file that the program's readers read is noted with the SHA-256 of its content: specs,
/// libraries, glTF, images. It holds for the process, as tbb::global_control does, because what is read is decided deep
/// within parsers; of several at once the youngest notes.
class InputRecord {
 public:
  InputRecord();
  ~InputRecord();
  InputRecord(const InputRecord&) = delete;
  InputRecord& operator=(const InputRecord&) = delete;

  /// SHA-256 by path, as far as read. Readers must not be at work in other threads.
  const std::map<std::string, std::string>& files() const { return files_; }

 private:
  friend void record_input(const std::filesystem::path& path, std::string_view content);
  friend void record_input_file(const std::filesystem::path& path);
  void add(const std::filesystem::path& path, std::string sha256);

  std::map<std::string, std::string> files_;
  InputRecord* outer_;
};

/// For readers: notes the file where somebody asked for it. `content` is the whole of it.
void record_input(const std::filesystem::path& path, std::string_view content);
/// The same for a file that a library reads by its path. Throws Error when it cannot be read.
void record_input_file(const std::filesystem::path& path);

}  // namespace fathom
