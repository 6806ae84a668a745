// Runs the program as a user does.
#pragma once

#include <string>

namespace fathom {

struct ProgramRun {
  int exit_code;
  std::string out;
  std::string err;
};

/// `arguments` as typed in a shell.
ProgramRun run_fathom(const std::string& arguments);

}  // namespace fathom
