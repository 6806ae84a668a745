#include "openni2/property_value.h"

namespace fathom {
namespace {

template <class T>
OniStatus copy(const T& value, void* data) {
  std::memcpy(data, &value, sizeof value);
  return ONI_STATUS_OK;
}

template <class Narrow, class Wide>
OniStatus write_number(Wide value, void* data, int size) {
  if (size == sizeof(Wide)) return copy(value, data);
  if (size == sizeof(Narrow)) return copy(static_cast<Narrow>(value), data);
  return ONI_STATUS_BAD_PARAMETER;
}

}  // namespace

OniStatus write_property(const PropertyValue& value, void* data, int* size) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return write_number<std::int32_t>(*integer, data, *size);
  if (const auto* real = std::get_if<double>(&value)) return write_number<float>(*real, data, *size);
  const Bytes& bytes = std::get<Bytes>(value);
  if (*size < static_cast<int>(bytes.size())) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, bytes.data(), bytes.size());
  *size = static_cast<int>(bytes.size());
  return ONI_STATUS_OK;
}

}  // namespace fathom
