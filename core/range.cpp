#include "core/range.h"

#include <fmt/format.h>

namespace fathom {

bool Range::contains(double number) const { return number <= high && (open_low ? number > low : number >= low); }

std::string Range::text() const {
  const bool from = low > -1e300, to = high < 1e300;
  if (from && to)
    return open_low ? fmt::format("a number above {} and at most {}", low, high)
                    : fmt::format("a number from {} to {}", low, high);
  if (from) return fmt::format("a number {} {}", open_low ? "above" : "of at least", low);
  if (to) return fmt::format("a number of at most {}", high);
  return "a number";
}

}  // namespace fathom
