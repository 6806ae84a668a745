// Checks a PCD file's header against its length before PCL trusts it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fathom {

/// What PCL must agree on.
struct PcdHeader {
  std::size_t body;         ///< where the points begin
  std::uint64_t raw_bytes;  ///< of all points, unpacked and binary
};

/// Throws Error when the header has no x, y, z or makes no sense, when the body is shorter than it promises, and when
/// the points would take more memory than the InputPolicy allows.
PcdHeader check_pcd(const std::string& file, std::string_view content);

}  // namespace fathom
