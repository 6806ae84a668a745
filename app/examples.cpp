#include "app/examples.h"

#include "core/error.h"
#include "core/files.h"

namespace fathom {

std::string with_scenes(std::string examples, const std::filesystem::path& folder) {
  constexpr std::string_view kWritten = " scenes/";
  const std::string meant = " " + (folder / "").string();
  for (std::size_t at = 0; (at = examples.find(kWritten, at)) != std::string::npos; at += meant.size())
    examples.replace(at, kWritten.size(), meant);
  return examples;
}

std::string examples_from_here(std::string examples) {
  std::error_code none;
  if (std::filesystem::is_directory("scenes/templates", none)) return examples;
  try {
    return with_scenes(examples, data_directory());
  } catch (const Error&) {
    return examples;  // help is shown without the data as well
  }
}

}  // namespace fathom
