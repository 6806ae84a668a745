// What the formulas of this folder demand of their arguments.
#pragma once

#include <stdexcept>

namespace fathom::theory {

/// Throws std::invalid_argument unless `holds`. Write conditions so that NaN makes them false.
inline void require(bool holds, const char* demand) {
  if (!holds) throw std::invalid_argument(demand);
}

}  // namespace fathom::theory
