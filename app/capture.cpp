// `fathom capture`: one simulated shot of a scene, or several.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/options.h"
#include "app/output_size.h"
#include "app/print.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/image_file.h"
#include "core/input_record.h"
#include "core/manifest.h"
#include "core/median.h"
#include "core/progress.h"
#include "core/rows.h"
#include "core/units.h"
#include "sim/effects/effects_json.h"
#include "sim/render/overlap.h"
#include "sim/scene/doubts.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"
#include "sim/sensor/capture_files.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct CaptureOptions {
  fs::path scene, model;
  std::string mode = "photometric", light = "auto";
  int spp = kDefaultSamplesPerPixel;
  int frames = 1;
  bool device_outputs = false;
  bool yes = false;
};

/// What a person wants to know at once.
std::vector<Row> summary(const Frame& frame, const Image<TruePixel>& truth) {
  constexpr double kOutlier = 0.010;  // [m]: matched to another surface
  double lit = 0, valid = 0, outliers = 0;
  std::vector<double> errors;  // [m], where both depths exist
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double depth = frame.depth.pixels()[i];
    const std::optional<double>& apparent = truth.pixels()[i].apparent_depth;
    valid += depth > 0.0;
    lit += apparent.has_value();
    if (!apparent || depth <= 0.0) continue;
    errors.push_back(std::fabs(depth - *apparent));
    outliers += errors.back() > kOutlier;
  }
  const double both = static_cast<double>(errors.size());
  std::vector<Row> rows{{"pixels_lit", lit, "px"}, {"pixels_valid", valid, "px"}};
  if (lit > 0) rows.push_back({"valid_of_lit", both / lit, ""});
  if (errors.empty()) return rows;
  rows.push_back({"median_depth_error", mm_from_metres(median(std::move(errors))), "mm"});
  rows.push_back({"beyond_10_mm", outliers / both, ""});
  return rows;
}

bool has_depth(const Image<float>& depth) {
  return std::any_of(depth.pixels().begin(), depth.pixels().end(), [](float metres) { return metres > 0.0f; });
}

/// The folder of a capture, which goes on where an earlier run of the same capture stopped.
class CaptureFolder {
 public:
  CaptureFolder(const fs::path& folder, const RunIdentity& identity, int frames, std::vector<std::string> names)
      : folder_(folder), owner_(folder), manifest_(folder, identity), frames_(frames), names_(std::move(names)) {
    manifest_.require_same_command(capture_names(folder_));
    if (manifest_.difference()) {
      manifest_.forget_files();
      remove_capture(folder_);
    }
    fs::remove(folder_ / kRecord);
    manifest_.begin();
  }

  fs::path frame(int number) const { return frame_folder(folder_, number, frames_); }

  /// Whether all files of the frame stand there as they were written.
  bool holds(int number) const {
    return std::all_of(names_.begin(), names_.end(),
                       [&](const std::string& name) { return manifest_.holds(noted(number, name)); });
  }

  void note(int number) {
    for (const std::string& name : names_) manifest_.add(noted(number, name));
  }

  void write(const ResolvedScene& resolved) {
    write_scene_files(folder_, resolved);
    for (const NamedFile& file : resolved.files) manifest_.add(file.name);
  }

  /// Last: the presence of run.json says that the capture is complete.
  void finish(const Json& record) {
    manifest_.add("truth.exr");
    manifest_.finish();
    write_json(folder_ / kRecord, record);
  }

 private:
  static constexpr const char* kRecord = "run.json";

  std::string noted(int number, const std::string& name) const {
    return (frame(number) / name).lexically_relative(folder_).string();
  }

  fs::path folder_;
  FolderOwner owner_;
  Manifest manifest_;
  int frames_;
  std::vector<std::string> names_;
};

void run(const CaptureOptions& options, const CommonOptions& common) {
  const auto start = std::chrono::steady_clock::now();
  const InputRecord inputs;
  Setup setup = read_setup(options.scene);
  for (const std::string& doubt : scene_doubts(setup))
    print_warning(fmt::format("{}: {}", options.scene.string(), doubt));
  require_apart(setup);
  if (!options.model.empty()) setup = with_effects_of_model(std::move(setup), options.model);
  const CaptureMode mode = options.mode == "geometric" ? CaptureMode::geometric : CaptureMode::photometric;
  const std::optional<LightModel> light = light_named(options.light);
  const OutputSize size{static_cast<double>(options.frames),
                        capture_bytes(setup.rig.sensor, mode == CaptureMode::photometric, options.device_outputs)};
  const std::string sentence = require_space(common, size, options.yes);
  if (options.frames > 1) announce(common, sentence);
  Progress progress(options.frames == 1 ? "capture" : "frame", static_cast<std::size_t>(options.frames), common.quiet);
  Camera camera(setup, mode, options.spp, common.seed, light);
  const SensorModel& sensor = camera.setup().rig.sensor;
  const ResolvedScene resolved = resolved_scene(camera.setup());  // before anything goes that it may name
  CaptureFolder folder(common.output,
                       {"capture",
                        {{"seed", common.seed},
                         {"mode", options.mode},
                         {"light", options.light},
                         {"spp", options.spp},
                         {"frames", options.frames},
                         {"device_outputs", options.device_outputs}},
                        inputs.files()},
                       options.frames, frame_files(mode == CaptureMode::photometric, options.device_outputs));
  folder.write(resolved);
  write_truth(common.output, camera.truth());
  std::vector<Row> rows;
  int without_depth = 0;
  for (int i = 0; i < options.frames; ++i, progress.step()) {
    const fs::path place = folder.frame(i);
    if (i > 0 && folder.holds(i)) {  // the first is shot in any case: its summary is printed
      without_depth += !has_depth(read_exr_channel(place / "depth.exr", "Z"));
      continue;
    }
    make_directory(place);
    remove_leftovers(place);
    const Frame frame = camera.shoot(static_cast<std::uint64_t>(i));
    write_frame(place, frame, camera.truth(), sensor.noise.bits);
    if (options.device_outputs) write_device_outputs(place, sensor, frame);
    folder.note(i);
    without_depth += !has_depth(frame.depth);
    if (i == 0) rows = summary(frame, camera.truth());
  }
  Json record = run_record(camera, resolved);
  record["fathom"] = FATHOM_VERSION;
  record["mode"] = options.mode;
  record["light"] = name_of(camera.light());
  if (!options.model.empty()) record["model"] = read_json(options.model);
  record["spp"] = camera.samples_per_pixel();
  record["frames"] = options.frames;
  record["seed"] = common.seed;
  record["timing"]["total_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  folder.finish(record);
  if (without_depth > 0)
    print_warning(fmt::format("{}: frames without a pixel that has a depth: {} of {}; is anything lit and in range?",
                              options.scene.string(), without_depth, options.frames));
  print_text(format_rows(rows, common.json));
}

}  // namespace

std::function<void()> define_capture(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<CaptureOptions>();
  app.add_option("scene", options->scene, "Scene file (*.json)")->required();
  app.add_option("--model", options->model, "Model of a diagnosis, whose effects are there as well")
      ->type_name("M.json");
  app.add_option("--mode", options->mode,
                 "geometric: exact triangulation, images only of liquids that scatter; photometric: infrared image and "
                 "matching")
      ->check(one_of("mode", {"geometric", "photometric"}))
      ->capture_default_str();
  app.add_option("--spp", options->spp, "Samples per infrared pixel, on a square grid")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option(
         "--light", options->light,
         "Direct: from the projector to what the camera sees, liquids that scatter are opaque; full: interreflected, "
         "mirrored and scattered as well; auto: full where a cup or anything else stands, unless a liquid scatters as "
         "paint does (reduced scattering from 20 per mm). To direct light geometric captures add only what liquids "
         "scatter")
      ->check(one_of("light", light_names()))
      ->capture_default_str();
  app.add_option("--frames", options->frames, "Shots; more than one go to DIR/frame_0000 …")
      ->check(CLI::Range(1, kMostFrames))
      ->capture_default_str();
  app.add_flag("--device-outputs", options->device_outputs,
               "Also what the device sends: depth in 100 µm, raw shifts, and depth registered to the colour camera");
  app.add_flag("--yes", options->yes, "Also where it writes more than 20 GB");
  return [options, &common] { run(*options, common); };
}

}  // namespace fathom
