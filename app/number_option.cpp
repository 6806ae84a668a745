#include "app/number_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace fathom {

std::function<std::string(const std::string&)> number_within(Range range) {
  return [range](const std::string& text) {
    double number = 0.0;
    const bool allowed = CLI::detail::lexical_cast(text, number) && range.contains(number);
    return allowed ? std::string() : fmt::format("must be {}, got '{}'", range.text(), text);
  };
}

}  // namespace fathom
