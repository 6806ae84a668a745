#include "diagnosis/measurement/check_clouds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/input_policy.h"
#include "core/median.h"
#include "core/units.h"
#include "detector/quiet_pcl.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/sensed_frame.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

fs::path path_of(const Table& table, std::size_t row, std::string_view column, const fs::path& folder) {
  return path_named_in((folder / "frames.csv").string(), table.place(row, column), table.text(row, column));
}

class CloudChecker {
 public:
  CloudChecker(const fs::path& folder, const Table& table, const std::vector<FrameRecord>& frames,
               MeasurementCheck& check)
      : folder_(folder), table_(table), frames_(frames), check_(check) {}

  /// What the clouds say that are read.
  void look() {
    constexpr std::size_t kMost = 8;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < frames_.size(); ++row)
      if (!frames_[row].cloud.empty()) rows.push_back(row);
    const std::size_t count = std::min(rows.size(), kMost);
    const QuietPcl quiet;
    std::vector<std::size_t> silent, bare;
    std::vector<double> height_mm, pitch_deg, roll_deg;
    bool is_bright = true;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t row = rows[count == 1 ? 0 : i * (rows.size() - 1) / (count - 1)];
      const Cloud cloud = read_frame_cloud(frames_[row], folder_, table_, row);
      if (i == 0) check_.width = cloud.width, check_.height = cloud.height;
      is_bright = is_bright && !cloud.intensity.empty();
      const auto estimates = estimate_frame(sensed_points(cloud, check_.rig), check_.rig, view_of(frames_[row]));
      if (!estimates || !is_near(estimates->desk, check_.rig)) {
        silent.push_back(row);
        continue;
      }
      if (!frames_[row].bare_desk() && shows_desk(*estimates, check_.rig)) bare.push_back(row);
      for (const NamedValue& value : named_values(*estimates)) {
        if (value.observable == "desk_height_mm") height_mm.push_back(value.value);
        if (value.observable == "desk_pitch_deg") pitch_deg.push_back(value.value);
        if (value.observable == "desk_roll_deg") roll_deg.push_back(value.value);
      }
    }
    check_.clouds_read = count;
    note(Lack::desk_in_sight, kNoDesk, silent);
    note(Lack::cup_in_sight, kNoCup, bare);
    compare_pose(height_mm, pitch_deg, roll_deg);
    if (count > 0 && !is_bright) add({Lack::brightness});
  }

  /// A copy that broke off leaves a part of a file. Without rows clouds are of many sizes.
  void look_at_sizes() {
    constexpr double kPart = 0.5;  // of the median
    std::vector<double> sizes;
    std::vector<std::size_t> rows, short_ones;
    for (std::size_t row = 0; row < frames_.size(); ++row) {
      if (frames_[row].cloud.empty()) continue;
      std::error_code problem;
      sizes.push_back(static_cast<double>(fs::file_size(path_of(table_, row, "cloud", folder_), problem)));
      rows.push_back(row);
    }
    if (sizes.empty() || check_.height <= 1) return;
    const double usual = median(sizes);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (sizes[i] < kPart * usual) short_ones.push_back(rows[i]);
    if (!short_ones.empty()) add({Lack::whole_clouds, 0.0, names_of(short_ones)});
  }

 private:
  void add(Shortfall shortfall) { check_.lacks.push_back(std::move(shortfall)); }

  /// Where it is most of the clouds a diagnosis stops as well.
  void note(Lack lack, const Misplaced& what, const std::vector<std::size_t>& rows) {
    if (rows.empty()) return;
    finding_of(what, rows, check_.clouds_read, table_, "clouds that were looked at");
    add({lack, 0.0, names_of(rows)});
  }

  std::vector<std::string> names_of(const std::vector<std::size_t>& rows) const {
    std::vector<std::string> names;
    for (const std::size_t row : rows) names.push_back(frames_[row].frame);
    return names;
  }

  /// A tape finds more than these; less is for the diagnosis, which knows how sure it is.
  void compare_pose(const std::vector<double>& height_mm, const std::vector<double>& pitch_deg,
                    const std::vector<double>& roll_deg) {
    constexpr double kHeight_mm = 5.0, kAngle_deg = 0.5, kSigmas = 3.0;
    if (height_mm.empty()) return;
    const LaboratoryRig& rig = check_.rig;
    const auto compare = [&](Lack lack, const std::vector<double>& seen, double noted, const char* key, double least) {
      const auto sigma = rig.sigma.find(key);
      const double off = median(seen) - noted;
      if (std::abs(off) > std::max(least, sigma == rig.sigma.end() ? 0.0 : kSigmas * sigma->second)) add({lack, off});
    };
    // Of the camera, at the baseline's left end.
    const double camera_m = rig.height_m + 0.5 * rig.baseline_m * std::sin(rig.roll_rad);
    compare(Lack::desk_height, height_mm, mm_from_metres(camera_m), "height_mm", kHeight_mm);
    compare(Lack::desk_pitch, pitch_deg, deg_from_radians(rig.pitch_rad), "pitch_deg", kAngle_deg);
    compare(Lack::desk_roll, roll_deg, deg_from_radians(rig.roll_rad), "roll_deg", kAngle_deg);
  }

  const fs::path& folder_;
  const Table& table_;
  const std::vector<FrameRecord>& frames_;
  MeasurementCheck& check_;
};

}  // namespace

void require_files(const Table& table, std::string_view column, const fs::path& folder) {
  if (!table.has(column)) return;
  std::vector<std::size_t> missing, empty;
  std::size_t named = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, column).empty()) continue;
    ++named;
    std::error_code problem;
    const fs::path file = path_of(table, row, column, folder);
    if (!fs::is_regular_file(file, problem))
      missing.push_back(row);
    else if (fs::file_size(file, problem) == 0)
      empty.push_back(row);
  }
  const auto fail = [&](const std::vector<std::size_t>& rows, const char* what) {
    if (rows.empty()) return;
    const std::string file = path_of(table, rows.front(), column, folder).string();
    table.fail(rows.front(), column,
               fmt::format("{} {}{}", what, file,
                           rows.size() > 1 ? fmt::format(", and {} more of {} files", rows.size() - 1, named) : ""));
  };
  fail(missing, "there is no file");
  fail(empty, "there is nothing in");
}

void check_clouds(const fs::path& folder, const Table& table, const std::vector<FrameRecord>& frames,
                  MeasurementCheck& check) {
  CloudChecker checker(folder, table, frames, check);
  checker.look();
  checker.look_at_sizes();
}

}  // namespace fathom
