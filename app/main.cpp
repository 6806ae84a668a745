// The table of commands. The only place that prints errors and exits.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/visible_text.h"

namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

/// The word that should be a command must be one: CLI11 would only say that it did not expect it.
void check_command(int argc, char** argv) {
  std::vector<std::string> names;
  for (const fathom::Command& command : fathom::kCommands) names.emplace_back(command.name);
  if (argc < 2) throw fathom::UsageError(fmt::format("a command is missing, choose from {}", fmt::join(names, ", ")));
  const std::string word = argv[1];
  if (word.starts_with('-') || std::find(names.begin(), names.end(), word) != names.end()) return;
  throw fathom::UsageError(fathom::unknown_name("command", word, names));
}

int bad_usage(const std::string& what) {
  fmt::print(stderr, "error: {}\nRun with --help for more information.\n", fathom::on_one_line(what));
  return kBadUsage;
}

void add_common_options(CLI::App& app, fathom::CommonOptions& common) {
  app.add_option("-o,--output", common.output, "Folder for the results")->type_name("DIR");
  app.add_option("--seed", common.seed, "Seed of everything random")
      ->check([](const std::string& text) {
        return text.starts_with('-') ? std::string("must be at least 0") : std::string();
      })
      ->capture_default_str();
  app.add_option("--threads", common.threads, "Threads; 0 = all")->check(CLI::Range(0, 1024))->capture_default_str();
  app.add_flag("--quiet", common.quiet, "No progress on the terminal");
  app.add_flag("--json", common.json, "Results as JSON on stdout");
}

}  // namespace

int main(int argc, char** argv) {
  fathom::keep_freed_pages();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of its writer, not the end
  CLI::App app("Fathom: simulates a structured-light depth camera that looks at cups with liquids in them", "fathom");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(FATHOM_VERSION));
  fathom::CommonOptions common;
  std::function<void()> run;
  for (const fathom::Command& command : fathom::kCommands) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.summary));
    sub->footer("Examples:\n" + std::string(command.examples));
    sub->callback([&run, body = command.define(*sub, common)] { run = body; });
    add_common_options(*sub, common);
  }

  try {
    check_command(argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const std::exception& problem) {
    return bad_usage(problem.what());
  }
  try {
    const auto threads =
        common.threads > 0 ? static_cast<unsigned>(common.threads) : std::max(1u, std::thread::hardware_concurrency());
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw fathom::Error("stdout", "cannot be written");
    return 0;
  } catch (const fathom::UsageError& problem) {
    return bad_usage(problem.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory\n");
  } catch (const std::exception& problem) {
    fmt::print(stderr, "error: {}\n", fathom::on_one_line(problem.what()));
  }
  return kFailed;
}
