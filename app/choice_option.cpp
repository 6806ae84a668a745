#include "app/choice_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/error.h"

namespace fathom {

CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names) {
  const auto wrong = [kind, names](const std::string& name) {
    const bool known = std::find(names.begin(), names.end(), name) != names.end();
    return known ? std::string() : unknown_name(kind, name, names);
  };
  return {wrong, fmt::format("{{{}}}", fmt::join(names, ",")), kind};
}

}  // namespace fathom
