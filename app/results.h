// Where the results of a command go that has no files of its own: to stdout, and with -o DIR to a file there too.
#pragma once

#include <string>

#include "app/command.h"

namespace fathom {

/// DIR/NAME.json with --json, else DIR/NAME and `extension`. Does nothing without -o.
void keep_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                  const std::string& text);

/// Prints the text, and keeps it.
void print_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text);

}  // namespace fathom
