// What the programs of the blind tests do with their command line, and with what goes wrong.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>

namespace fathom::blind {

/// The exit code: 2 for a command line that `app` does not take, 1 for a run that fails, with one line that says why.
inline int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& run) {
  try {
    app.parse(argc, argv);
    run();
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "error: {}\n", problem.what());
    return 1;
  }
  return 0;
}

}  // namespace fathom::blind
