// Runs the program as a user does.
#pragma once

#include <string>
#include <vector>

namespace fathom {

struct ProgramRun {
  int exit_code;
  std::string out;
  std::string err;
};

/// `arguments` as typed in a shell, and `environment` before the program's name: "NAME=value …".
ProgramRun run_fathom(const std::string& arguments, const std::string& environment = "");

/// The same several times at the same moment.
std::vector<ProgramRun> run_fathom_at_once(const std::string& arguments, int times);

}  // namespace fathom
