#include "diagnosis/measurement/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr std::array kColumns{"frame",  "session", "pour",        "placement",  "trial", "time_s",
                              "liquid", "fill_mm", "distance_mm", "lateral_mm", "cloud"};

int whole_number(const Table& frames, std::size_t row, const char* column) {
  const double value = frames.number(row, column);
  if (value < 0.0 || value > 1e9 || value != std::floor(value))
    frames.fail(row, column, fmt::format("must be a whole number from 0, got '{}'", frames.text(row, column)));
  return static_cast<int>(value);
}

/// Nothing where the table has no such column or the cell is empty; an error where it is below 0.
std::optional<double> not_negative(const Table& frames, std::size_t row, const char* column) {
  if (!frames.has(column)) return std::nullopt;
  const std::optional<double> value = frames.number_if_any(row, column);
  if (value && *value < 0.0)
    frames.fail(row, column, fmt::format("must be at least 0, got '{}'", frames.text(row, column)));
  return value;
}

/// A cup nearer than its own radius would stand below the sensor's foot: such a distance was written in metres.
void require_mm(const Table& frames, std::size_t row, const FrameRecord& record, const LaboratoryRig& rig) {
  if (record.bare_desk()) return;
  if (record.distance_m > 0.0 && record.distance_m < metres_from_mm(10.0))
    frames.fail(row, "distance_mm", fmt::format("must be in mm, got '{}'", frames.text(row, "distance_mm")));
  if (record.fill_m < 0.0 || record.fill_m > rig.cup_height_m - rig.bottom_m)
    frames.fail(row, "fill_mm",
                fmt::format("must be from 0 to {:g}, the depth of the cup, got '{}'",
                            mm_from_metres(rig.cup_height_m - rig.bottom_m), frames.text(row, "fill_mm")));
}

FrameRecord read_frame(const Table& frames, std::size_t row, const std::vector<std::string>& liquids,
                       const std::filesystem::path& folder) {
  FrameRecord record;
  record.frame = frames.text(row, "frame");
  record.liquid = frames.text(row, "liquid");
  if (std::find(liquids.begin(), liquids.end(), record.liquid) == liquids.end())
    frames.fail(row, "liquid", unknown_name("liquid", record.liquid, liquids));
  record.session = whole_number(frames, row, "session");
  record.pour = whole_number(frames, row, "pour");
  record.placement = whole_number(frames, row, "placement");
  record.trial = whole_number(frames, row, "trial");
  record.time_s = frames.number(row, "time_s");
  not_negative(frames, row, "time_s");
  record.fill_m = metres_from_mm(frames.number(row, "fill_mm"));
  record.distance_m = metres_from_mm(frames.number(row, "distance_mm"));
  record.lateral_m = metres_from_mm(frames.number(row, "lateral_mm"));
  record.cloud = frames.text(row, "cloud");
  if (!record.cloud.empty() && !std::filesystem::is_regular_file(folder / record.cloud))
    frames.fail(row, "cloud", fmt::format("there is no file {}", (folder / record.cloud).string()));
  record.height_sd_mm = not_negative(frames, row, "height_sd_mm");
  record.points = not_negative(frames, row, "points");
  if (frames.has("height_mm")) record.height_mm = frames.number_if_any(row, "height_mm");
  if (record.cloud.empty() && !record.bare_desk() && !record.height_mm)
    frames.fail(row, "cloud", "is empty, and there is no height_mm in its place");
  return record;
}

void set_stood(std::vector<FrameRecord>& records) {
  using Pour = std::tuple<int, int, std::string, double>;
  const auto pour_of = [](const FrameRecord& r) { return Pour(r.session, r.pour, r.liquid, r.fill_m); };
  std::map<Pour, double> first_s;
  for (const FrameRecord& record : records) {
    double& first = first_s.try_emplace(pour_of(record), record.time_s).first->second;
    first = std::min(first, record.time_s);
  }
  for (FrameRecord& record : records)
    if (!record.bare_desk()) record.stood_s = record.time_s - first_s.at(pour_of(record));
}

}  // namespace

std::vector<FrameRecord> read_frames(const Table& frames, const LaboratoryRig& rig,
                                     const std::filesystem::path& folder) {
  for (const char* column : kColumns)
    if (!frames.has(column)) throw Error(frames.file(), "line 1", fmt::format("has no column '{}'", column));
  if (frames.rows() == 0) throw Error(frames.file(), "has no frames below its header");
  std::vector<std::string> liquids{"empty", "none"};
  for (const auto& [name, medium] : rig.liquids) liquids.push_back(name);
  std::vector<FrameRecord> records;
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    records.push_back(read_frame(frames, row, liquids, folder));
    require_mm(frames, row, records.back(), rig);
  }
  set_stood(records);
  return records;
}

}  // namespace fathom
