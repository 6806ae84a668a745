// blind_generate: makes packs of measurements in which something is hidden.
#include <fmt/format.h>

#include <filesystem>

#include "blind/command_line.h"
#include "blind/pack.h"
#include "blind/settle.h"
#include "blind/write_set.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace {

namespace fs = std::filesystem;
using namespace fathom;

struct Options {
  fs::path pack, truth, ledger, answer;
  std::string kind = "development";
  std::uint64_t seed = 1;
  int sets = 100, first = 0, last = -1, set = 0;
};

void require_set(const blind::Pack& pack, int number, const char* option) {
  if (number < 0 || number >= static_cast<int>(pack.sets.size()))
    throw Error(option, fmt::format("must be from 0 to {}", pack.sets.size() - 1));
}

/// Sets that are there are left: a second run goes on where the first stopped.
void write_sets(const Options& options) {
  const blind::Pack pack = blind::open_pack(options.pack, options.truth);
  const int last = options.last < 0 ? static_cast<int>(pack.sets.size()) - 1 : options.last;
  require_set(pack, options.first, "--first");
  require_set(pack, last, "--last");
  Progress progress("set", static_cast<std::size_t>(last - options.first + 1), false);
  for (int i = options.first; i <= last; ++i, progress.step()) {
    const fs::path folder = blind::set_folder(options.pack, i);
    if (!fs::exists(folder)) blind::write_set(pack.sets[static_cast<std::size_t>(i)], folder);
  }
}

/// Nothing is written where the answer leaves nothing open that it knows how to settle.
void write_follow_up(const Options& options) {
  const auto promise = blind::promise_of(blind::read_answer(options.answer));
  if (!promise) return;
  const blind::Pack pack = blind::open_pack(options.pack, options.truth);
  require_set(pack, options.set, "--set");
  const fs::path folder = options.pack / "follow_ups" / blind::set_folder(options.pack, options.set).filename();
  if (fs::exists(folder)) return;
  blind::write_follow_up(pack.sets[static_cast<std::size_t>(options.set)],
                         blind::read_follow_up(options.answer / promise->spec), folder);
}

void define(CLI::App& app, Options& options) {
  app.require_subcommand(1);
  CLI::App* seal = app.add_subcommand("seal", "Draw what is hidden in each set, write and hash the truth");
  CLI::App* sets = app.add_subcommand("sets", "Write the measurement directories of a sealed pack");
  CLI::App* follow_up = app.add_subcommand(
      "follow_up", "Make the measurement that an answer proposes to settle what it leaves open: PACK/follow_ups/NNNN");
  CLI::App* exact = app.add_subcommand("exact", "Write the full design without effects, errors and noise");
  for (CLI::App* command : {seal, sets, follow_up, exact})
    command->add_option("-o,--output", options.pack, "Folder of the pack")->required();
  for (CLI::App* command : {seal, sets, follow_up})
    command->add_option("--truth", options.truth, "The truth's file, outside the pack")->required();
  seal->add_option("--kind", options.kind, "development, validation or sealed")->capture_default_str();
  seal->add_option("--seed", options.seed, "Each kind has seeds of its own")->capture_default_str();
  seal->add_option("--sets", options.sets, "Number of sets")->check(CLI::Range(1, 9999))->capture_default_str();
  seal->add_option("--ledger", options.ledger, "Append-only list of packs");
  sets->add_option("--first", options.first, "First set to write")->capture_default_str();
  sets->add_option("--last", options.last, "Last set to write (default: all)");
  seal->callback(
      [&] { blind::seal_pack(options.kind, options.seed, options.sets, options.pack, options.truth, options.ledger); });
  sets->callback([&] { write_sets(options); });
  follow_up->add_option("--set", options.set, "The set that was answered")->required();
  follow_up->add_option("--answer", options.answer, "Folder of the answer: report.json, next.json and its specs")
      ->required();
  follow_up->callback([&] { write_follow_up(options); });
  exact->callback([&] { blind::write_exact_set(options.pack); });
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Makes packs of measurements in which something is hidden, by physics of its own");
  define(app, options);
  return blind::run_program(app, argc, argv, [] {});
}
