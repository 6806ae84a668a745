// Options whose value is one of some names.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class Validator;
}

namespace fathom {

/// For CLI::Option::check. Help and completions show the names; an error says which one is near.
CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names);

}  // namespace fathom
