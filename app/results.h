// Where the results of a command go that has no files of its own: to stdout, and with -o DIR to a file there too.
#pragma once

#include <string>

#include "app/command.h"

namespace fathom {

/// DIR/NAME.json with --json, else DIR/NAME and `extension`. Does nothing without -o. For the folder's owner
/// (core/folder_owner.h).
void write_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text);

/// Removes DIR/NAME.json and DIR/NAME with `extension`, whose presence says that the files beside them are complete.
void remove_results(const CommonOptions& common, const std::string& name, const std::string& extension);

/// Prints the text, and keeps it as write_results() does. Throws Error where another process owns the folder.
void print_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text);

}  // namespace fathom
