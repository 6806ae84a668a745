// What a fuzzer makes up, as the file that a reader wants.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/error.h"

namespace fathom {

/// A path of this process, below which nobody else writes.
inline std::filesystem::path fuzz_path(const std::string& extension) {
  static const std::string stem =
      (std::filesystem::temp_directory_path() / ("fathom_fuzz_" + std::to_string(::getpid()))).string();
  return stem + extension;
}

inline void write_fuzz(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Writes the bytes to a file of this process and calls `read` with its path. An Error is the reader's right answer;
/// everything else that it throws is a finding.
template <class Read>
int fuzz_file(const std::uint8_t* data, std::size_t size, const std::string& extension, Read read) {
  const std::filesystem::path path = fuzz_path(extension);
  write_fuzz(path, {reinterpret_cast<const char*>(data), size});
  try {
    read(path);
  } catch (const Error&) {
  }
  std::filesystem::remove(path);
  return 0;
}

/// The same of a reader of folders: the bytes are its files `names` one after the other, parted by lines of "%%%". What
/// has no part is not there.
template <class Read>
int fuzz_folder(const std::uint8_t* data, std::size_t size, std::initializer_list<const char*> names, Read read) {
  constexpr std::string_view kBorder = "\n%%%\n";
  const std::filesystem::path folder = fuzz_path("");
  std::filesystem::create_directory(folder);
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  for (const char* name : names) {
    const std::size_t end = rest.find(kBorder);
    write_fuzz(folder / name, rest.substr(0, end));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + kBorder.size());
  }
  try {
    read(folder);
  } catch (const Error&) {
  }
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace fathom
