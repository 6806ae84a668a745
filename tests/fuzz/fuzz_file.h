// What a fuzzer makes up, as the file that a reader wants.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

namespace fathom {

/// Writes the bytes to a file of this process and calls `read` with its path. An Error is the reader's right answer;
/// everything else that it throws is a finding.
template <class Read>
int fuzz_file(const std::uint8_t* data, std::size_t size, const std::string& extension, Read read) {
  static const std::string stem =
      (std::filesystem::temp_directory_path() / ("fathom_fuzz_" + std::to_string(::getpid()))).string();
  const std::filesystem::path path = stem + extension;
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    read(path);
  } catch (const Error&) {
  }
  std::filesystem::remove(path);
  return 0;
}

}  // namespace fathom
