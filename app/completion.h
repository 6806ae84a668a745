// Scripts by which shells complete the program's commands, options and their values.
#pragma once

#include <string>

#include "app/command_facts.h"

namespace fathom {

std::string bash_completion(const CommandFacts& program);
std::string zsh_completion(const CommandFacts& program);
std::string fish_completion(const CommandFacts& program);

}  // namespace fathom
