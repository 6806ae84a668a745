// The values of OpenNI2's properties, and how they cross its C interface: an address, and a size that says the type.
#pragma once

#include <OniCTypes.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <variant>
#include <vector>

namespace fathom {

using Bytes = std::vector<std::uint8_t>;
/// Integers are asked for in 4 or 8 bytes, reals as float or double, anything else as its bytes.
using PropertyValue = std::variant<std::int64_t, double, Bytes>;

template <class T>
Bytes bytes_of(const T* values, std::size_t count) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
  return Bytes(bytes, bytes + count * sizeof(T));
}

/// Writes the value to `data` of `*size` bytes and says how many it took.
OniStatus write_property(const PropertyValue& value, void* data, int* size);

/// What a client set, if it has the size of a T.
template <class T>
std::optional<T> read_property(const void* data, int size) {
  if (size != static_cast<int>(sizeof(T))) return std::nullopt;
  T value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

}  // namespace fathom
