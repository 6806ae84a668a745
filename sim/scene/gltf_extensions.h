// What a glTF file says its reader must know.
#pragma once

#include <string>
#include <string_view>

namespace fathom {

/// Throws Error where `extensionsRequired` names what Fathom does not know; a file without that extension would be
/// another thing. Whatever else is wrong with the JSON is left to its reader.
void require_known_extensions(std::string_view json, const std::string& file);

}  // namespace fathom
