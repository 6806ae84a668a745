// Numbers typed on the command line.
#pragma once

#include <functional>
#include <string>

#include "core/range.h"

namespace fathom {

/// For CLI::Option::check: empty when the text is a finite number of the range, else what must be. CLI11's own checks
/// let NaN pass.
std::function<std::string(const std::string&)> number_within(Range range);

}  // namespace fathom
