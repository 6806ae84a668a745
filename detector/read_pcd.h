// The points of a PCD file.
#pragma once

#include <string>
#include <string_view>

#include "detector/cloud.h"

namespace fathom {

/// x, y, z and intensity, whatever other fields stand beside them; as text, binary or packed. Throws Error where the
/// file is malformed or cut short, and where its points would take more memory than the InputPolicy allows.
Cloud read_pcd(const std::string& file, std::string_view content);

}  // namespace fathom
