// Numbers typed on the command line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/range.h"

namespace CLI {
class App;
}

namespace fathom {

/// For CLI::Option::check: empty when the text is a finite number of the range, else what must be. CLI11's own checks
/// let NaN pass.
std::function<std::string(const std::string&)> number_within(Range range);

/// An option that takes numbers of the range, parted by commas or blanks. CLI11's own lists drop what is empty.
void add_number_list(CLI::App& app, const char* name, std::vector<double>& values, const char* what, Range range);

/// Makes every option of the command and of those below it that takes a number refuse what is none that it can hold.
/// They are known by CLI11's names of their types: one that is called otherwise needs number_within(). CLI11 takes an
/// empty text for 0, cuts a whole number that is too large to the largest one, and reads 010 as 8. Called once, when
/// all options are there.
void require_numbers(CLI::App& command);

}  // namespace fathom
