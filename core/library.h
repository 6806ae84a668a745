// The libraries that come with the program: scenes/cups, scenes/media, scenes/walls, scenes/solids,
// scenes/sensors, one JSON file per entry.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

/// Names of the entries of a library ("cups", "media", "walls", "solids", "sensors"), sorted.
std::vector<std::string> library_names(std::string_view library);

/// The entry's file. Throws Error with the choices when there is none; `file` and `where` say who asked.
std::filesystem::path library_file(std::string_view library, std::string_view kind, const std::string& name,
                                   const std::string& file, const std::string& where);

}  // namespace fathom
