// What a folder holds, to be compared with another.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/files.h"

namespace fathom {

/// The bytes of every file below the folder by its name there, but for the locks of folders.
inline std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != ".fathom.lock")
      files[entry.path().lexically_relative(folder).string()] = read_text(entry.path());
  return files;
}

}  // namespace fathom
