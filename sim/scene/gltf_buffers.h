// Which other files a glTF file names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fathom {

/// The files of its buffers, relative to its folder; none of those that lie in the file itself. Throws Error when one
/// lies outside the folder.
std::vector<std::string> gltf_buffers(const std::filesystem::path& gltf, const std::string& content);

}  // namespace fathom
