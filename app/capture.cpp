// `fathom capture`: one simulated shot of a scene, or several.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <string>

#include "app/capture_files.h"
#include "app/commands.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/rows.h"
#include "core/units.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"

namespace fathom {
namespace {

struct CaptureOptions {
  std::filesystem::path scene;
  std::string mode = "photometric";
  int spp = 4;
  int frames = 1;
};

/// What a person wants to know at once.
std::vector<Row> summary(const Frame& frame, const Image<TruePixel>& truth) {
  double expected = 0, valid = 0, squared = 0, both = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double depth = frame.depth.pixels()[i];
    const std::optional<double>& apparent = truth.pixels()[i].apparent_depth;
    valid += depth > 0.0;
    if (!apparent) continue;
    ++expected;
    if (depth <= 0.0) continue;
    ++both;
    squared += (depth - *apparent) * (depth - *apparent);
  }
  std::vector<Row> rows{{"pixels_lit", expected, "px"}, {"pixels_valid", valid, "px"}};
  if (expected > 0) rows.push_back({"valid_of_lit", both / expected, ""});
  if (both > 0) rows.push_back({"rms_depth_error", mm_from_metres(std::sqrt(squared / both)), "mm"});
  return rows;
}

void run(const CaptureOptions& options, const CommonOptions& common) {
  const auto start = std::chrono::steady_clock::now();
  const Setup setup = read_setup(options.scene);
  const CaptureMode mode = options.mode == "geometric" ? CaptureMode::geometric : CaptureMode::photometric;
  make_directory(common.output);
  Camera camera(setup, mode, options.spp, common.seed);
  write_truth(common.output, camera.truth());
  Progress progress("frame", static_cast<std::size_t>(options.frames), common.quiet || options.frames == 1);
  std::vector<Row> rows;
  for (int i = 0; i < options.frames; ++i) {
    const std::filesystem::path folder =
        options.frames == 1 ? common.output : common.output / fmt::format("frame_{:04}", i);
    make_directory(folder);
    const Frame frame = camera.shoot(static_cast<std::uint64_t>(i));
    write_frame(folder, frame, camera.truth());
    if (i == 0) rows = summary(frame, camera.truth());
    progress.step();
  }
  Json record = run_record(setup, camera);
  record["fathom"] = FATHOM_VERSION;
  record["mode"] = options.mode;
  record["spp"] = options.spp;
  record["frames"] = options.frames;
  record["seed"] = common.seed;
  record["timing"]["total_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_json(common.output / "run.json", record);  // last: its presence says that the capture is complete
  fmt::print("{}", format_rows(rows, common.json));
}

}  // namespace

std::function<void()> define_capture(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<CaptureOptions>();
  app.add_option("scene", options->scene, "Scene file (*.json)")->required();
  app.add_option("--mode", options->mode, "geometric: exact triangulation; photometric: infrared image and matching")
      ->check(CLI::IsMember({"geometric", "photometric"}))
      ->capture_default_str();
  app.add_option("--spp", options->spp, "Samples per infrared pixel, on a square grid")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--frames", options->frames, "Shots; more than one go to DIR/frame_0000 …")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  return [options, &common] {
    require_output(common);
    run(*options, common);
  };
}

}  // namespace fathom
