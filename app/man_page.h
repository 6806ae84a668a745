// Man pages of the program and its commands.
#pragma once

#include <string>

#include "app/command_facts.h"

namespace fathom {

/// "fathom-capture" of "fathom capture"
std::string page_name(const CommandFacts& command);

/// The page in the macros of man(7). A command's own commands have sections of it; the program's have pages of their
/// own.
std::string man_page(const CommandFacts& command, bool is_program);

}  // namespace fathom
