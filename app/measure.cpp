// fathom measure: fills the height columns of a measurement directory from its clouds.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "campaign/cup_height.h"
#include "core/error.h"
#include "core/folder_owner.h"
#include "core/progress.h"
#include "core/rows.h"
#include "core/table.h"
#include "core/units.h"
#include "diagnosis/measurement/frame_cloud.h"

namespace fathom {
namespace {

constexpr std::array kHeightColumns{"height_mm", "height_sd_mm", "points"};

/// One line, with the first few frames by name.
void warn(NoHeight reason, const std::vector<std::string>& frames) {
  print_warning(
      fmt::format("{} frames have no height because {}: {}", frames.size(), name_of(reason), name_list(frames)));
}

void run_measure(const std::filesystem::path& folder, const CommonOptions& common) {
  const LaboratoryRig rig = read_rig(folder / "rig.json");
  Table frames = read_table(folder / "frames.csv");
  const std::vector<FrameRecord> records = read_frames(frames, rig, folder);
  for (const char* column : kHeightColumns)
    if (!frames.has(column)) frames.add_column(column);

  int clouds = 0, measured = 0;
  std::map<NoHeight, std::vector<std::string>> frames_without;
  Progress progress("measure", frames.rows(), common.quiet);
  for (std::size_t row = 0; row < frames.rows(); ++row, progress.step()) {
    const FrameRecord& record = records[row];
    if (record.cloud.empty()) continue;
    for (const char* column : kHeightColumns) frames.set(row, column, "");
    if (record.bare_desk()) continue;
    ++clouds;
    const auto found = height_in_cup(read_frame_cloud(record, folder, frames, row), rig,
                                     Eigen::Vector2d(record.lateral_m, record.distance_m));
    if (const NoHeight* reason = std::get_if<NoHeight>(&found)) {
      frames_without[*reason].push_back(record.frame);
      continue;
    }
    const InteriorHeight& height = std::get<InteriorHeight>(found);
    ++measured;
    frames.set(row, "height_mm", fmt::format("{:.4f}", mm_from_metres(height.mean_m)));
    frames.set(row, "height_sd_mm", fmt::format("{:.4f}", mm_from_metres(height.sd_m)));
    frames.set(row, "points", fmt::format("{}", height.points));
  }
  for (const auto& [reason, numbers] : frames_without) warn(reason, numbers);
  if (clouds > 0 && measured == 0)
    throw Error(folder.string(),
                "none of its clouds has a height in the cup: does rig.json say how the sensor stands?");
  const std::filesystem::path output = common.output.empty() ? folder : common.output;
  const FolderOwner owner(output);
  write_table(output / "heights.csv", frames);
  if (std::all_of(records.begin(), records.end(), [](const FrameRecord& record) { return record.cloud.empty(); }))
    print_note("frames.csv names no clouds: heights.csv has the heights that stand there already");
  print_text(format_rows(
      {{"clouds_with_cup", static_cast<double>(clouds), ""}, {"heights_measured", static_cast<double>(measured), ""}},
      common.json));
}

}  // namespace

std::function<void()> define_measure(CLI::App& app, const CommonOptions& common) {
  const auto folder = add_measurement_folder(app);
  return [folder, &common] { run_measure(*folder, common); };
}

}  // namespace fathom
