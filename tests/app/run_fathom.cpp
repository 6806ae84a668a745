#include "tests/app/run_fathom.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/files.h"

namespace fathom {

ProgramRun run_fathom(const std::string& arguments) {
  const std::string base = fmt::format("{}fathom_run_{}", testing::TempDir(), ::getpid());
  const std::string command = fmt::format("{} {} > {}.out 2> {}.err", FATHOM_PROGRAM, arguments, base, base);
  const int status = std::system(command.c_str());
  ProgramRun run{WEXITSTATUS(status), read_text(base + ".out"), read_text(base + ".err")};
  std::filesystem::remove(base + ".out");
  std::filesystem::remove(base + ".err");
  return run;
}

}  // namespace fathom
