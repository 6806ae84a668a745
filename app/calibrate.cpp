// fathom calibrate: how a real device differs from its model, from clouds of desks and walls.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "core/error.h"
#include "core/folder_owner.h"
#include "diagnosis/unit/calibration_clouds.h"
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

std::vector<CalibrationCloud> clouds_of(const CalibrateOptions& options) {
  std::optional<double> interval_s;
  if (options.interval_s > 0.0) interval_s = options.interval_s;
  if (interval_s && std::ranges::any_of(options.files, is_table))
    throw UsageError("--interval-s says when the clouds named here were taken; a frames.csv has time_s for that");
  std::vector<CalibrationCloud> clouds = calibration_clouds(options.files, interval_s);
  if (clouds.empty()) throw UsageError("needs a CLOUD");
  return clouds;
}

void run_calibrate(const CalibrateOptions& options, const CommonOptions& common) {
  require_gnuplot();
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
  if (unit.views == 1)
    print_note(
        "there is one view, so nothing tells the device's bias from this desk's own shape; move the sensor or "
        "the desk and take more");
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
