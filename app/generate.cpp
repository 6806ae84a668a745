// `fathom generate`: labelled frames of random desks, in the layouts that others load.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.h"
#include "app/options.h"
#include "app/output_size.h"
#include "app/print.h"
#include "core/files.h"
#include "core/rows.h"
#include "datasets/generate.h"

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

/// What a frame's files take in whole blocks of a disk, a tenth more than was measured: a bare desk, what each thing on
/// it adds by its masks, edges and labels, and the infrared image.
double labelled_frame_bytes(const DatasetSpec& spec) {
  constexpr double kBareDesk = 190e3, kThing = 27e3, kInfrared = 430e3;
  const ClutterSpec& desk = spec.clutter;
  const double things = 0.5 * (desk.cups.low + desk.cups.high + desk.objects.low + desk.objects.high);
  return kBareDesk + kThing * things + (spec.mode == CaptureMode::photometric ? kInfrared : 0.0);
}

void run_generate(const GenerateOptions& options, const CommonOptions& common) {
  const Shard shard = shard_of(options.shard);
  const std::filesystem::path file = options.spec.empty() ? shipped_dataset_spec() : options.spec;
  const DatasetRun run = dataset_run([&] { return read_dataset_spec(file, common.seed); }, common.seed, options.frames);
  const int missing = frames_of(common.output, run.dataset, shard).missing;
  const std::string size =
      require_space(common, {static_cast<double>(missing), labelled_frame_bytes(run.dataset.spec)}, options.yes);
  if (missing > 0) announce(common, size);
  const MadeFrames made = make_frames(common.output, run, shard, common.quiet);
  print_text(format_rows({{"frames", static_cast<double>(made.frames)},
                          {"frames_made_now", static_cast<double>(made.made_now)},
                          {"complete", made.complete ? "yes" : "no"},
                          {"page", made.complete ? (common.output / "index.html").string() : ""}},
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
