#include "diagnosis/unit/calibration_clouds.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_policy.h"
#include "core/table.h"

namespace fathom {
namespace {

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

}  // namespace

bool is_table(const std::filesystem::path& file) { return file.extension() == ".csv"; }

std::vector<CalibrationCloud> calibration_clouds(std::span<const std::filesystem::path> files,
                                                 std::optional<double> interval_s) {
  const auto tables = std::ranges::count_if(files, is_table);
  std::vector<CalibrationCloud> clouds;
  for (const std::filesystem::path& file : files) {
    if (is_table(file)) {
      add_clouds_of(file, tables == 1, clouds);
      continue;
    }
    clouds.push_back({file, {}});
    if (interval_s) clouds.back().time_s = *interval_s * static_cast<double>(clouds.size() - 1);
  }
  return clouds;
}

}  // namespace fathom
