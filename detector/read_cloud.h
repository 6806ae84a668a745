// Clouds from files: PCD (ascii, binary, binary_compressed) and PLY, with any fields beside x, y, z.
#pragma once

#include <filesystem>
#include <string>

#include "detector/cloud.h"

namespace fathom {

/// Metres are taken for granted, and the points as take_as_measured() has them. A VIEWPOINT is ignored: files in
/// circulation disagree with their own. Throws Error when the file is missing, malformed, truncated or has no x, y, z.
Cloud read_cloud(const std::filesystem::path& path);

/// Empty, or a sentence of what is doubtful: most points lie farther away than such a camera measures.
std::string doubt_of_units(const Cloud& cloud);

}  // namespace fathom
