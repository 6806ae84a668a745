// The examples that a command's help shows.
#pragma once

#include <filesystem>
#include <string>

namespace fathom {

/// The examples, which were written for `scenes/`, with `folder` in its place.
std::string with_scenes(std::string examples, const std::filesystem::path& folder);

/// The examples as they run from the working directory: where it has no `scenes/`, with the folder that the program
/// finds.
std::string examples_from_here(std::string examples);

}  // namespace fathom
