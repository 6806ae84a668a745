// fathom calibrate: how a real device differs from its model, from clouds of desks and walls.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.h"
#include "app/detector_options.h"
#include "app/gnuplot.h"
#include "app/number_option.h"
#include "app/print.h"
#include "app/unit_report.h"
#include "core/folder_owner.h"
#include "core/input_policy.h"
#include "core/table.h"

namespace fathom {
namespace {

struct CalibrateOptions {
  std::vector<std::filesystem::path> files;
  DeskOptions desk;
  double focal_px = 0.0, interval_s = 0.0;
  bool registered = false;
};

/// Clouds as they are named; of a frames.csv those of its rows, with their times.
std::vector<CalibrationCloud> clouds_of(const CalibrateOptions& options) {
  std::vector<CalibrationCloud> clouds;
  for (const std::filesystem::path& file : options.files) {
    if (file.extension() != ".csv") {
      clouds.push_back({file, {}});
      if (options.interval_s > 0.0) clouds.back().time_s = options.interval_s * static_cast<double>(clouds.size() - 1);
      continue;
    }
    const Table frames = read_table(file);
    frames.need("cloud");
    for (std::size_t row = 0; row < frames.rows(); ++row) {
      const std::string& name = frames.text(row, "cloud");
      if (name.empty()) continue;
      clouds.push_back({path_named_in(file.string(), "column 'cloud'", name), {}});
      if (frames.has("time_s")) clouds.back().time_s = frames.number_if_any(row, "time_s");
    }
  }
  if (clouds.empty()) throw UsageError("needs a CLOUD");
  return clouds;
}

void run_calibrate(const CalibrateOptions& options, const CommonOptions& common) {
  require_output(common);
  require_gnuplot();
  CalibrationOptions how;
  how.mounted = options.desk.prior();
  if (options.focal_px > 0.0) how.focal_px = options.focal_px;
  if (options.registered) how.registered = true;
  const Calibration unit = calibrate(clouds_of(options), how, common.quiet);
  const FolderOwner owner(common.output);
  write_unit_report(common.output, unit);
  write_unit(common.output, unit);
  print_text(format_rows(unit_rows(unit), common.json));
}

}  // namespace

std::function<void()> define_calibrate(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<CalibrateOptions>();
  app.add_option("clouds", options->files,
                 "PCD or PLY clouds of desks or walls, or a frames.csv that names clouds (and times, time_s)")
      ->required()
      ->type_name("CLOUD");
  add_desk_options(app, options->desk);
  app.add_option("--focal-px", options->focal_px,
                 "Of the infrared camera at 640 × 480, where depths and rays do not tell it")
      ->check(number_within({1.0, 1e6}))
      ->type_name("PX");
  app.add_option("--interval-s", options->interval_s,
                 "Time from cloud to cloud, the first when the device was switched on")
      ->check(number_within(kPositive))
      ->type_name("S");
  app.add_flag(
      "--registered", options->registered,
      "The clouds are the colour camera's, 25 mm beside the infrared one; organised clouds tell it themselves");
  return [options, &common] { run_calibrate(*options, common); };
}

}  // namespace fathom
