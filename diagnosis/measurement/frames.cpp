#include "diagnosis/measurement/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/input_policy.h"
#include "core/median.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_in_sight.h"

namespace fathom {
namespace {

constexpr std::array kColumns{"frame",  "session", "pour",    "placement",   "trial",
                              "time_s", "liquid",  "fill_mm", "distance_mm", "lateral_mm"};

int whole_number(const Table& frames, std::size_t row, const char* column) {
  const std::string& cell = frames.text(row, column);
  const bool is_number = !cell.empty() && cell.find_first_not_of("+-.0123456789eE") == std::string::npos;
  const double value = is_number ? frames.number(row, column) : -1.0;
  if (value < 0.0 || value > 1e9 || value != std::floor(value))
    frames.fail(row, column, fmt::format("must be a whole number from 0, got '{}'", cell));
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

/// What a liquid and a place cannot be, most often because of another unit.
void require_possible(const Table& frames, std::size_t row, const FrameRecord& record, const LaboratoryRig& rig) {
  const auto must = [&](const char* column, const std::string& what) {
    frames.fail(row, column, fmt::format("must be {}, got '{}'", what, frames.text(row, column)));
  };
  if (record.bare_desk()) {
    if (record.fill_m != 0.0) must("fill_mm", "0 where the liquid is none");
    if (record.distance_m != 0.0) must("distance_mm", "0 where the liquid is none");
    if (record.lateral_m != 0.0) must("lateral_mm", "0 where the liquid is none");
    return;
  }
  if (record.liquid == "empty" && record.fill_m != 0.0) must("fill_mm", "0 where the liquid is empty");
  if (record.fill_m < 0.0 || record.fill_m > rig.cup.height() - rig.cup.bottom())
    must("fill_mm",
         fmt::format("from 0 to {:g}, the depth of the cup", mm_from_metres(rig.cup.height() - rig.cup.bottom())));
  if (record.liquid != "empty" && record.fill_m == 0.0) must("fill_mm", "above 0, or the liquid empty");
  const Eigen::Vector2d place(record.lateral_m, record.distance_m);
  if (!is_in_sight(place, rig)) must("distance_mm", words_in_sight(place, rig));
}

/// Heights of tables, most often because of another unit: single ones may be noise, those of one filling are not.
void require_possible_heights(const Table& frames, const std::vector<FrameRecord>& records, const LaboratoryRig& rig) {
  constexpr double kLeastOfBottom = 0.25, kAboveRim_mm = 5.0;  // what no wrong cup makes of a height
  constexpr double kNoise_mm = 20.0;
  const double least = kLeastOfBottom * mm_from_metres(rig.cup.bottom()),
               most = mm_from_metres(rig.cup.height()) + kAboveRim_mm;
  std::map<std::tuple<int, std::string, double>, std::vector<std::size_t>> fillings;
  for (std::size_t row = 0; row < records.size(); ++row)
    if (const FrameRecord& r = records[row]; r.cloud.empty() && !r.bare_desk())
      fillings[{r.session, r.liquid, r.fill_m}].push_back(row);
  std::optional<std::size_t> first;
  for (const auto& [filling, rows] : fillings) {
    std::vector<double> heights_mm;
    for (const std::size_t row : rows) heights_mm.push_back(*records[row].height_mm);
    const double middle = median(heights_mm);
    const double noise = middle < least || middle > most ? 0.0 : kNoise_mm;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (*records[rows[i]].height_mm < least - noise || *records[rows[i]].height_mm > most + noise)
        first = std::min(first.value_or(rows[i]), rows[i]);
  }
  if (first)
    frames.fail(*first, "height_mm",
                fmt::format("must be in mm above the desk, from {:g} to {:g} in this cup, got '{}'", least, most,
                            frames.text(*first, "height_mm")));
}

/// Of the rows before a row: what it must not contradict.
class EarlierRows {
 public:
  explicit EarlierRows(const Table& frames) : frames_(frames) {}

  void add(std::size_t row, const FrameRecord& record) {
    if (!names_.emplace(record.session, record.frame).second)
      frames_.fail(row, "frame",
                   fmt::format("must be another one for every frame of a session, got '{}' again", record.frame));
    std::map<int, double>& times = times_[placement_of(record)];
    const auto [here, is_new] = times.emplace(record.trial, record.time_s);
    if (!is_new) return;  // nobody numbered these trials
    const auto later = std::next(here);
    if ((here != times.begin() && std::prev(here)->second > record.time_s) ||
        (later != times.end() && later->second < record.time_s))
      frames_.fail(
          row, "time_s",
          fmt::format("must not run backwards over the trials of a placement, got '{}'", frames_.text(row, "time_s")));
  }

 private:
  const Table& frames_;
  std::set<std::pair<int, std::string>> names_;          // session and frame
  std::map<PlacementKey, std::map<int, double>> times_;  // by trial
};

/// A file that a cell names; empty where it names none.
std::filesystem::path file_of(const Table& frames, std::size_t row, const char* column,
                              const std::filesystem::path& folder) {
  if (!frames.has(column) || frames.text(row, column).empty()) return {};
  const std::string& name = frames.text(row, column);
  const std::filesystem::path file = path_named_in((folder / "frames.csv").string(), frames.place(row, column), name);
  if (!std::filesystem::is_regular_file(file))
    frames.fail(row, column, fmt::format("there is no file {}", file.string()));
  return name;
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
  record.cloud = file_of(frames, row, "cloud", folder);
  record.infrared = file_of(frames, row, "ir", folder);
  if (!record.infrared.empty() && record.cloud.empty()) frames.fail(row, "ir", "needs a cloud beside it");
  record.height_sd_mm = not_negative(frames, row, "height_sd_mm");
  record.points = not_negative(frames, row, "points");
  if (frames.has("height_mm")) record.height_mm = frames.number_if_any(row, "height_mm");
  if (record.cloud.empty() && !record.bare_desk() && !record.height_mm) {
    if (!frames.has("cloud")) frames.fail(row, "height_mm", "is empty, and there is no cloud in its place");
    frames.fail(row, "cloud", "is empty, and there is no height_mm in its place");
  }
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

/// Nothing is put down on a bare desk that could be numbered: where its trials begin anew, or a cup stood there
/// meanwhile, is another view, which gets a number of its own.
void number_bare_desk_views(std::vector<FrameRecord>& records) {
  std::vector<FrameRecord*> bare;
  std::map<int, std::set<double>> times_of_cups;  // of each session
  for (FrameRecord& record : records)
    if (record.bare_desk())
      bare.push_back(&record);
    else
      times_of_cups[record.session].insert(record.time_s);
  std::stable_sort(bare.begin(), bare.end(), [](const FrameRecord* a, const FrameRecord* b) {
    return std::tie(a->session, a->time_s) < std::tie(b->session, b->time_s);
  });
  int view = 0;
  std::optional<FrameRecord> before;
  for (FrameRecord* record : bare) {
    const bool is_same_session = before && before->session == record->session;
    const std::set<double>& cups = times_of_cups[record->session];
    const bool is_same_view = is_same_session && placement_of(*before) == placement_of(*record) &&
                              before->trial <= record->trial &&
                              cups.upper_bound(before->time_s) == cups.lower_bound(record->time_s);
    if (!is_same_view) view = is_same_session ? view + 1 : 0;
    before = *record;
    record->placement = view;
  }
}

}  // namespace

PlacementKey placement_of(const FrameRecord& f) {
  return {f.session, f.pour, f.placement, f.liquid, f.fill_m, f.distance_m, f.lateral_m};
}

std::string place_name(double distance_mm, double lateral_mm) {
  return fmt::format("distance {:g} mm, lateral {:g} mm", distance_mm, lateral_mm);
}

std::string filling_name(const std::string& liquid, double fill_mm) {
  return liquid == "empty" ? liquid : fmt::format("{:g} mm of {}", fill_mm, liquid);
}

std::vector<FrameRecord> read_frames(const Table& frames, const LaboratoryRig& rig,
                                     const std::filesystem::path& folder) {
  for (const char* column : kColumns) frames.need(column);
  if (!frames.has("cloud") && !frames.has("height_mm"))
    throw Error(frames.file(), "line 1",
                "has neither a column 'cloud' nor a column 'height_mm', one of them is needed");
  if (frames.rows() == 0) throw Error(frames.file(), "has no frames below its header");
  std::vector<std::string> liquids{"empty", "none"};
  for (const auto& [name, medium] : rig.liquids) liquids.push_back(name);
  std::vector<FrameRecord> records;
  EarlierRows earlier(frames);
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    records.push_back(read_frame(frames, row, liquids, folder));
    require_possible(frames, row, records.back(), rig);
    earlier.add(row, records.back());
  }
  require_possible_heights(frames, records, rig);
  set_stood(records);
  number_bare_desk_views(records);
  return records;
}

}  // namespace fathom
