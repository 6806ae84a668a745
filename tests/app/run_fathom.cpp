#include "tests/app/run_fathom.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <future>

#include "core/files.h"

namespace fathom {

namespace {

/// Runs the program with its streams in files called `base`.
ProgramRun run_into(const std::string& base, const std::string& arguments, const std::string& environment) {
  const std::string command =
      fmt::format("{} {} {} > {}.out 2> {}.err", environment, FATHOM_PROGRAM, arguments, base, base);
  const int status = std::system(command.c_str());
  ProgramRun run{WEXITSTATUS(status), read_text(base + ".out"), read_text(base + ".err")};
  std::filesystem::remove(base + ".out");
  std::filesystem::remove(base + ".err");
  return run;
}

std::string base_name() { return fmt::format("{}fathom_run_{}", testing::TempDir(), ::getpid()); }

}  // namespace

ProgramRun run_fathom(const std::string& arguments, const std::string& environment) {
  return run_into(base_name(), arguments, environment);
}

std::vector<ProgramRun> run_fathom_at_once(const std::string& arguments, int times) {
  std::vector<std::future<ProgramRun>> running;
  for (int i = 0; i < times; ++i)
    running.push_back(std::async(std::launch::async, [&arguments, base = fmt::format("{}_{}", base_name(), i)] {
      return run_into(base, arguments, "");
    }));
  std::vector<ProgramRun> runs;
  for (std::future<ProgramRun>& run : running) runs.push_back(run.get());
  return runs;
}

}  // namespace fathom
