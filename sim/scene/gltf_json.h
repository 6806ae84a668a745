// What is asked of a glTF file's JSON beside its model.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

/// The JSON of a file; of a binary one its first chunk. Whatever is wrong with it is left to its reader to say.
std::string_view gltf_json(std::string_view content, bool binary);

/// Throws Error where `extensionsRequired` names what Fathom does not know; a file without that extension would be
/// another thing. Whatever else is wrong with the JSON is left to its reader.
void require_known_extensions(std::string_view json, const std::string& file);

/// The files that its buffers name, relative to its folder; none of those that lie in the file itself. Throws Error
/// when one lies outside the folder.
std::vector<std::string> gltf_buffers(const std::filesystem::path& gltf, const std::string& content);

}  // namespace fathom
