// fathom calibrate: how a real device differs from its model, from clouds of desks and walls.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/detector_options.h"
#include "app/number_option.h"
#include "app/print.h"
#include "app/results.h"
#include "core/error.h"
#include "core/folder_owner.h"
#include "core/input_policy.h"
#include "core/table.h"
#include "report/gnuplot.h"
#include "report/unit_report.h"

namespace fathom {
namespace {

struct CalibrateOptions {
  std::vector<std::filesystem::path> files;
  DeskOptions desk;
  double focal_px = 0.0, interval_s = 0.0;
  std::optional<bool> registered;
};

bool is_table(const std::filesystem::path& file) { return file.extension() == ".csv"; }

/// Whether `time_s` of the table is since one moment: it restarts with each session.
bool is_timed(const Table& frames) {
  if (!frames.has("time_s")) return false;
  for (std::size_t row = 1; frames.has("session") && row < frames.rows(); ++row)
    if (frames.text(row, "session") != frames.text(0, "session")) return false;
  return true;
}

void add_clouds_of(const std::filesystem::path& table, bool with_times, std::vector<CalibrationCloud>& clouds) {
  const Table frames = read_table(table);
  frames.need("cloud");
  with_times = with_times && is_timed(frames);
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    const std::string& name = frames.text(row, "cloud");
    if (name.empty()) continue;
    clouds.push_back({path_named_in(table.string(), frames.place(row, "cloud"), name), {}});
    if (!with_times) continue;
    clouds.back().time_s = frames.number_if_any(row, "time_s");
    if (clouds.back().time_s && *clouds.back().time_s < 0.0)
      frames.fail(row, "time_s", fmt::format("must be at least 0, got '{}'", frames.text(row, "time_s")));
  }
}

/// Clouds as they are named; of a frames.csv those of its rows, with their times where it is the only one.
std::vector<CalibrationCloud> clouds_of(const CalibrateOptions& options) {
  const auto tables = std::ranges::count_if(options.files, is_table);
  if (tables > 0 && options.interval_s > 0.0)
    throw UsageError("--interval-s says when the clouds named here were taken; a frames.csv has time_s for that");
  std::vector<CalibrationCloud> clouds;
  for (const std::filesystem::path& file : options.files) {
    if (is_table(file)) {
      add_clouds_of(file, tables == 1, clouds);
      continue;
    }
    clouds.push_back({file, {}});
    if (options.interval_s > 0.0) clouds.back().time_s = options.interval_s * static_cast<double>(clouds.size() - 1);
  }
  if (clouds.empty()) throw UsageError("needs a CLOUD");
  return clouds;
}

void run_calibrate(const CalibrateOptions& options, const CommonOptions& common) {
  require_report(common);
  CalibrationOptions how;
  how.mounted = options.desk.prior();
  if (options.focal_px > 0.0) how.focal_px = options.focal_px;
  how.registered = options.registered;
  const std::vector<CalibrationCloud> clouds = clouds_of(options);
  for (const CalibrationCloud& cloud : clouds)
    if (!std::filesystem::exists(cloud.file)) throw Error(cloud.file.string(), "no such file");
  const FolderOwner owner(common.output);  // what cannot be written shows before the long work
  const UnitCalibration unit = calibrate(clouds, how, common.quiet);
  std::filesystem::remove(common.output / "unit.json");  // of an earlier run: it does not belong to what follows
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
  app.add_option("--focal-px", options->focal_px, "Of the infrared camera at 640 × 480, whatever depths and rays tell")
      ->check(number_within({1.0, 1e6}))
      ->type_name("PX");
  app.add_option("--interval-s", options->interval_s,
                 "Seconds from one cloud to the next; the first was taken when the device was switched on")
      ->check(number_within(kPositive))
      ->type_name("S");
  app.add_flag_function(
      "--registered,!--unregistered", [options](std::int64_t sign) { options->registered = sign > 0; },
      "The clouds are the colour camera's, 25 mm beside the infrared one, or they are not; else their rays tell");
  return [options, &common] { run_calibrate(*options, common); };
}

}  // namespace fathom
