// What the programs of the blind tests do with their command line, and with what goes wrong.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "core/decimal.h"

namespace fathom::blind {

/// Puts a whole number as CLI11 reads it, or says what is wrong: CLI11 takes an empty text for 0, cuts numbers that are
/// too large, and reads 010 as 8.
inline std::string whole_number(std::string& text) {
  if (const auto number = decimal<std::int64_t>(text))
    text = fmt::to_string(*number);
  else if (const auto large = decimal<std::uint64_t>(text))
    text = fmt::to_string(*large);
  else
    return fmt::format("must be a whole number, got '{}'", text);
  return {};
}

inline void require_whole_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; }))
    if (const std::string type = option->get_type_name(); type.starts_with("INT") || type.starts_with("UINT"))
      option->transform(CLI::Validator(whole_number, ""));
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) require_whole_numbers(*below);
}

/// The exit code: 2 for a command line that `app` does not take, 1 for a run that fails, with one line that says why.
inline int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& run) {
  require_whole_numbers(app);
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
