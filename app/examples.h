// The examples that a command's help shows.
#pragma once

#include <filesystem>
#include <string>

namespace fathom {

/// The examples with another folder for `scenes/`, in which they were written.
std::string with_scenes(std::string examples, const std::filesystem::path& folder);

/// The examples with the scenes' folder as it is called from here, so that they run where the program was installed.
std::string examples_from_here(std::string examples);

}  // namespace fathom
