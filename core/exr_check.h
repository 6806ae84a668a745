// Whether an image's file is whole, without reading all of it.
#pragma once

#include <filesystem>

namespace fathom {

/// Throws Error unless the file is an OpenEXR image of that size [px] whose last line can be read: what was cut short
/// has none. Damage in between shows when the file is read.
void check_exr(const std::filesystem::path& path, int width, int height);

}  // namespace fathom
