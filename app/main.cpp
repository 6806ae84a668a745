// The table of commands. The only place that prints errors and exits.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/examples.h"
#include "app/options.h"
#include "app/print.h"
#include "core/error.h"
#include "core/input_policy.h"
#include "core/memory.h"
#include "core/standard_streams.h"

namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

/// Refuses a first word that is no command, and names the commands; then the same for the next word, where the command
/// has commands of its own. CLI11 would only say that it did not expect the word.
void check_command(const CLI::App& app, std::span<char* const> words) {
  std::vector<std::string> names;
  const CLI::App* chosen = nullptr;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(sub->get_name());
    if (!words.empty() && names.back() == words[0]) chosen = sub;
  }
  if (names.empty()) return;
  if (words.empty())
    throw fathom::UsageError(fmt::format("a command is missing, choose from {}", fmt::join(names, ", ")));
  if (chosen) return check_command(*chosen, words.subspan(1));
  if (*words[0] != '-') throw fathom::UsageError(fathom::unknown_name("command", words[0], names));
}

/// Refuses an option that none of the named commands has, and names those that they have: CLI11 would not.
void check_options(const CLI::App& app, std::span<char* const> words) {
  std::vector<std::string> names;
  const auto add_names = [&](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  };
  add_names(app);
  const CLI::App* command = &app;
  for (const std::string_view word : words) {
    if (word == "--") return;
    for (const CLI::App* below :
         command->get_subcommands([&](const CLI::App* each) { return each->get_name() == word; })) {
      if (command == &app) names.clear();
      add_names(*below);
      command = below;
    }
    const std::string name(word.substr(0, word.find('=')));
    if (name.starts_with("--") && std::find(names.begin(), names.end(), name) == names.end())
      throw fathom::UsageError(fathom::unknown_name("option", name, names));
  }
}

int bad_usage(const std::string& what) {
  fathom::print_error(what, "Run with --help for more information.\n");
  return kBadUsage;
}

void add_common_options(CLI::App& app, const fathom::Command& command, fathom::CommonOptions& common) {
  const std::string output(command.output), kind = output == "DIR" ? "folder" : "file";
  app.add_option("-o,--output", common.output, output == "DIR" ? "Folder for the results" : "File for the result")
      ->type_name(output)
      ->check([kind](const std::string& text) { return text.empty() ? "must name a " + kind + ", got ''" : ""; })
      ->required(command.needs_output);
  app.add_option("--seed", common.seed, "Seed of everything random")->capture_default_str();
  app.add_option("--threads", common.threads, "Threads; 0 = all")->check(CLI::Range(0, 1024))->capture_default_str();
  app.add_flag("--quiet", common.quiet, "No progress on the terminal");
  app.add_flag("--json", common.json, "Results as JSON on stdout");
  app.add_option("--max-input-mb", common.max_input_mb, "Memory that one file which is read may claim, in megabytes")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_flag("--allow-outside", common.allow_outside, "Files that are read may name others outside their folder");
}

}  // namespace

int main(int argc, char** argv) {
  fathom::occupy_standard_streams();
  fathom::keep_freed_pages();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of its writer, not the end
  CLI::App app("Fathom: simulates a structured-light depth camera that looks at cups with liquids in them", "fathom");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(FATHOM_VERSION));
  app.footer("'fathom COMMAND --help' lists a command's options and examples that run.");
  fathom::CommonOptions common;
  std::function<void()> run;
  for (const fathom::Command& command : fathom::kCommands) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.summary));
    sub->footer("Examples:\n" + fathom::examples_from_here(std::string(command.examples)));
    sub->callback([&run, body = command.define(*sub, common)] { run = body; });
    add_common_options(*sub, command, common);
  }
  fathom::require_numbers(app);

  try {
    const auto words = std::span(argv, static_cast<std::size_t>(argc)).subspan(1);
    check_command(app, words);
    check_options(app, words);
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    app.exit(help);
    return std::cout.flush() ? 0 : kFailed;
  } catch (const std::exception& problem) {
    return bad_usage(problem.what());
  }
  try {
    const auto threads =
        common.threads > 0 ? static_cast<unsigned>(common.threads) : std::max(1u, std::thread::hardware_concurrency());
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const fathom::InputPolicyScope policy({.most_bytes = static_cast<std::uint64_t>(common.max_input_mb) * 1'000'000,
                                           .allow_outside = common.allow_outside});
    run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw fathom::Error("stdout", "cannot be written");
    return 0;
  } catch (const fathom::UsageError& problem) {
    return bad_usage(problem.what());
  } catch (const std::bad_alloc&) {
    fathom::print_error("out of memory");
  } catch (const std::filesystem::filesystem_error& problem) {
    fathom::print_error(problem.path1().string() + ": " + problem.code().message());
  } catch (const std::exception& problem) {
    fathom::print_error(problem.what());
  }
  return kFailed;
}
