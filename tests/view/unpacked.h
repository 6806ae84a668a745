// What packed() made, as the pages' script reads it.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "core/json.h"

namespace fathom {

/// The bytes of a block.
std::string inflated(const Json& block);

template <class T>
std::vector<T> unpacked(const Json& block) {
  const std::string bytes = inflated(block);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}  // namespace fathom
