// The value in the middle.
#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

namespace fathom {

/// Half of the values are smaller; of an even number the upper of the two in the middle. There must be one.
template <class T>
T median(std::vector<T> values) {
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace fathom
