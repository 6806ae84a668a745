#include "core/library.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"

namespace fathom {

std::vector<std::string> library_names(std::string_view library) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(data_directory() / library))
    if (entry.path().extension() == ".json" && !entry.path().filename().string().starts_with('.'))
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path library_file(std::string_view library, std::string_view kind, const std::string& name,
                                   const std::string& file, const std::string& where) {
  const std::vector<std::string> names = library_names(library);
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(file, where, unknown_name(kind, name, names));
  return data_directory() / library / (name + ".json");
}

}  // namespace fathom
