// JSON as the program writes it, into files and on stdout.
#pragma once

#include <string>

#include "core/json.h"

namespace fathom {

/// Indented, with a line feed at the end. Bytes that are no UTF-8, as in the names of some files, are U+FFFD.
std::string json_text(const Json& value);

}  // namespace fathom
