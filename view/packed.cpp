#include "view/packed.h"

#include <zlib.h>

#include <bit>
#include <string_view>

#include "core/base64.h"
#include "core/error.h"

namespace fathom {
namespace {

template <class T>
Json deflated(const char* type, std::span<const T> values) {
  static_assert(std::endian::native == std::endian::little);
  uLongf size = compressBound(static_cast<uLong>(values.size_bytes()));
  std::string bytes(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(values.data()),
               static_cast<uLong>(values.size_bytes())) != Z_OK)
    throw Error("the page's data cannot be compressed: not enough memory");
  return {{"type", type}, {"deflate", base64(std::string_view(bytes).substr(0, size))}};
}

}  // namespace

Json packed(std::span<const std::uint8_t> values) { return deflated("u8", values); }
Json packed(std::span<const std::uint16_t> values) { return deflated("u16", values); }
Json packed(std::span<const std::int16_t> values) { return deflated("i16", values); }
Json packed(std::span<const std::uint32_t> values) { return deflated("u32", values); }

}  // namespace fathom
