// Checks a PCD or PLY file's header against its length before a reader trusts it.
#pragma once

#include <filesystem>

namespace fathom {

enum class CloudFormat { kPcd, kPly };

/// The format by content, not by name. Throws Error when the file is missing or neither PCD nor PLY, when the header
/// has no x, y, z or makes no sense, and when the body is shorter than the header promises.
CloudFormat check_cloud_header(const std::filesystem::path& path);

}  // namespace fathom
