// `fathom generate`: labelled frames of random desks, in the layouts that others load.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands.h"
#include "app/output_size.h"
#include "app/print.h"
#include "app/shard.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/input_record.h"
#include "core/progress.h"
#include "core/rows.h"
#include "datasets/dataset_page.h"
#include "datasets/scene_folder.h"

namespace fathom {
namespace {

struct GenerateOptions {
  std::filesystem::path spec;
  int frames = 1000;
  std::string shard{kWhole};
  bool example = false, yes = false;
};

/// The shipped specification, without the name of a schema that does not lie beside a copy.
std::string example_text() {
  std::string text = read_text(shipped_dataset_spec());
  if (const std::size_t begin = text.find("  \"$schema\""); begin != std::string::npos)
    text.erase(begin, text.find('\n', begin) + 1 - begin);
  return text;
}

/// Where a specification asks for more things than have room, the first frames say so before a folder is made.
void try_scenes(const Dataset& dataset) {
  constexpr int kTried = 50;
  for (int frame = 0; frame < std::min(dataset.frames, kTried); ++frame)
    dataset_scene(dataset.spec, dataset.seed, frame);
}

/// The data set, and in `identity` what it was read from: the record ends before frames are made, which would note
/// every file of theirs.
Dataset read_dataset(const std::filesystem::path& file, const GenerateOptions& options, const CommonOptions& common,
                     RunIdentity& identity) {
  const InputRecord inputs;
  Dataset dataset{.spec = read_dataset_spec(file, common.seed), .seed = common.seed, .frames = options.frames};
  try_scenes(dataset);
  identity.inputs = inputs.files();
  return dataset;
}

void run_generate(const GenerateOptions& options, const CommonOptions& common) {
  const Shard shard = shard_of(options.shard);
  const std::filesystem::path file = options.spec.empty() ? shipped_dataset_spec() : options.spec;
  RunIdentity identity{"generate", {{"seed", common.seed}}};
  const Dataset dataset = read_dataset(file, options, common, identity);
  int mine = 0, missing = 0;  // frames of this shard
  for (int scene = shard.number; scene < dataset.scenes(); scene += shard.count) {
    mine += dataset.frames_in(scene);
    missing += missing_frames(common.output, dataset, scene);
  }
  // Depths and masks of the shipped specification take 0.3 MB, infrared images as much again.
  const double bytes = dataset.spec.mode == CaptureMode::photometric ? 1.2e6 : 0.7e6;
  const std::string size = require_space(common, {static_cast<double>(missing), bytes}, options.yes);
  // Shards share the folder: each owns it while it begins and ends, and in between its own scenes.
  {
    const FolderOwner owner(common.output, kShardPatience);
    write_common(common.output, dataset, identity);
  }
  if (missing > 0) announce(common, size);
  Progress progress("frame", mine, common.quiet);
  int made = 0;
  for (int scene = shard.number; scene < dataset.scenes(); scene += shard.count)
    made += write_scene(common.output, dataset, scene, identity, [&] { progress.step(); });
  const FolderOwner owner(common.output, kShardPatience);
  const bool complete = is_complete(common.output, dataset);
  if (complete) write_dataset_page(common.output, dataset);
  print_text(format_rows({{"frames", static_cast<double>(mine)},
                          {"frames_made_now", static_cast<double>(made)},
                          {"complete", complete ? "yes" : "no"},
                          {"page", complete ? (common.output / "index.html").string() : ""}},
                         common.json));
}

}  // namespace

std::function<void()> define_generate(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<GenerateOptions>();
  app.add_option("spec", options->spec, "What is drawn (*.json); without it the one that --example prints")
      ->type_name("SPEC");
  app.add_option("--frames", options->frames, "How many frames the data set has; more can be added later")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  add_shard_option(app, options->shard);
  app.add_flag("--example", options->example, "Prints a specification to start from, and makes nothing");
  app.add_flag("--yes", options->yes, "Also where it writes more than 20 GB");
  return [options, &common] {
    if (options->example) return print_text(example_text());
    require_output(common);
    run_generate(*options, common);
  };
}

}  // namespace fathom
