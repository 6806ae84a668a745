// Checks an OpenEXR file's header before OpenEXR trusts it.
#pragma once

#include <string>
#include <string_view>

namespace fathom {

/// Throws Error unless `content` begins as an OpenEXR file of one part in scanlines, whose attributes lie within the
/// file, whose pixels fit into the memory that the InputPolicy allows, and could be packed in as few bytes as follow.
void check_exr_header(const std::string& file, std::string_view content);

}  // namespace fathom
