// The header of a PLY file: what its elements are made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyType {
  enum class Kind { integer, natural, real };
  Kind kind;
  std::size_t bytes;
};

struct PlyProperty {
  std::string name;
  PlyType type;                          ///< of the value, or of each in a list
  std::optional<PlyType> length_type{};  ///< of a list's length; nothing where this is no list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties{};

  /// Of one, at least: in bytes, or in characters with what parts them.
  std::uint64_t least_size(PlyEncoding encoding) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  std::uint64_t columns = 0, rows = 0;  ///< of an organised cloud, where the header tells them
  std::string_view body;
  std::uint64_t body_line = 1;  ///< its number in the file, from 1
};

/// Throws Error when the header makes no sense, has no vertex or no x, y, z, when the body is shorter than it promises,
/// and when the points would take more memory than the InputPolicy allows. `body` is a part of `content`.
PlyHeader read_ply_header(const std::string& file, std::string_view content);

}  // namespace fathom
