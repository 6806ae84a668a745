// What triangles take of memory, to be asked before they are made.
#pragma once

#include <cstdint>

namespace fathom {

/// [bytes] of a mesh with normals, and of what the ray tracer makes of it.
inline std::uint64_t traced_bytes(std::uint64_t vertices, std::uint64_t triangles) {
  constexpr std::uint64_t kVertex = 64;     // position and normal in double precision, position in single
  constexpr std::uint64_t kTriangle = 256;  // corners twice, and the tree of boxes
  return kVertex * vertices + kTriangle * triangles;
}

}  // namespace fathom
