// The header of a PCD file: what its points are made of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

enum class PcdEncoding { text, binary, packed };

struct PcdField {
  std::string name;
  char type;                   ///< F, I or U
  std::uint64_t bytes, count;  ///< of one value; values in a point
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t columns, rows;
  PcdEncoding encoding;
  std::string_view body;
  std::uint64_t body_line;  ///< its number in the file, from 1

  std::uint64_t points() const { return columns * rows; }
  std::uint64_t point_bytes() const;
};

/// Throws Error when the header has no x, y, z or makes no sense, when the body is shorter than it promises, and when
/// the points would take more memory than the InputPolicy allows. `body` is a part of `content`.
PcdHeader read_pcd_header(const std::string& file, std::string_view content);

}  // namespace fathom
