#include "diagnosis/measurement/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/error.h"
#include "core/input_policy.h"
#include "core/json.h"
#include "core/median.h"
#include "core/units.h"
#include "diagnosis/decision/sufficiency.h"
#include "diagnosis/measurement/cup_in_sight.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/sensed_frame.h"
#include "diagnosis/measurement/unit_bias.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

using Condition = std::tuple<std::string, double, double, double>;

Condition condition_of(const FrameRecord& f) { return {f.liquid, f.fill_m, f.distance_m, f.lateral_m}; }

std::string place_name(const FrameRecord& f) {
  return fathom::place_name(mm_from_metres(f.distance_m), mm_from_metres(f.lateral_m));
}

std::string filling_name(const FrameRecord& f) { return fathom::filling_name(f.liquid, mm_from_metres(f.fill_m)); }

Eigen::Vector2d place_of(const FrameRecord& f) { return {f.lateral_m, f.distance_m}; }

fs::path path_of(const Table& table, std::size_t row, std::string_view column, const fs::path& folder) {
  return path_named_in((folder / "frames.csv").string(), table.place(row, column), table.text(row, column));
}

/// Throws Error on files of a column that are missing or empty, and counts them: read_frames() would tell of the first
/// alone.
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

/// Of some of the clouds: what they show otherwise than the notes. Throws Error where most of them show no desk, or no
/// cup.
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

/// Of the table.
class Checker {
 public:
  Checker(const std::vector<FrameRecord>& frames, MeasurementCheck& check) : frames_(frames), check_(check) {}

  void count() {
    std::set<int> sessions;
    std::set<std::tuple<int, int, std::string, double>> pours;
    std::map<PlacementKey, std::size_t> placements;
    for (const FrameRecord& f : frames_) {
      sessions.insert(f.session);
      check_.clouds += !f.cloud.empty();
      check_.heights += f.cloud.empty() && !f.bare_desk();
      check_.bare_desk_views += f.bare_desk();
      if (f.bare_desk()) continue;
      check_.fills_mm[f.liquid].insert(mm_from_metres(f.fill_m));
      check_.distances_mm.insert(mm_from_metres(f.distance_m));
      check_.laterals_mm.insert(mm_from_metres(f.lateral_m));
      if (f.liquid != "empty") pours.emplace(f.session, f.pour, f.liquid, f.fill_m);
      ++placements[placement_of(f)];
    }
    check_.frames = frames_.size(), check_.sessions = sessions.size(), check_.pours = pours.size();
    check_.placements = placements.size();
    for (const auto& [key, trials] : placements) {
      check_.fewest_trials = check_.fewest_trials == 0 ? trials : std::min(check_.fewest_trials, trials);
      check_.most_trials = std::max(check_.most_trials, trials);
    }
  }

  /// `rig`: the file's text.
  void find_lacks(const Json& rig) {
    std::set<Condition> conditions;
    for (const FrameRecord& f : frames_) conditions.insert(condition_of(f));
    const bool is_desk_known =
        check_.rig.unit.map && std::ranges::all_of(frames_, [](const FrameRecord& f) { return f.bare_desk(); });
    if (conditions.size() < kFewestConditions && !is_desk_known)
      add({Lack::conditions, static_cast<double>(conditions.size())});
    look_at_places();
    look_into_cups();
    if (check_.heights > 0) add({Lack::clouds, static_cast<double>(check_.heights)});
    look_for_bare_desk();
    look_for_repeats();
    look_for_contrasts();
    look_at_sigmas(rig);
    std::stable_sort(check_.lacks.begin(), check_.lacks.end(),
                     [](const Shortfall& a, const Shortfall& b) { return a.lack < b.lack; });
  }

 private:
  void add(Shortfall shortfall) { check_.lacks.push_back(std::move(shortfall)); }

  /// Once for each place.
  void look_at_places() {
    std::map<std::pair<double, double>, const FrameRecord*> places;
    for (const FrameRecord& f : frames_)
      if (!f.bare_desk()) places.emplace(std::pair(f.distance_m, f.lateral_m), &f);
    Shortfall cut{Lack::cup_in_image, 1.0};
    for (const auto& [place, frame] : places) {
      const double share = share_in_image(place_of(*frame), check_.rig);
      if (share < 1.0) cut.size = std::min(cut.size, share), cut.names.push_back(place_name(*frame));
    }
    if (!cut.names.empty()) add(std::move(cut));
  }

  /// Once for each condition. How high clouds show something is not known yet: at least as high as a clear liquid lifts
  /// the bottom, by a third of its depth.
  void look_into_cups() {
    constexpr double kLift = 1.0 / 3.0;
    std::map<Condition, const FrameRecord*> conditions;
    for (const FrameRecord& f : frames_)
      if (!f.bare_desk()) conditions.emplace(condition_of(f), &f);
    Shortfall hidden{Lack::inside_in_sight, kFewestInRegion};
    for (const auto& [condition, frame] : conditions) {
      const double height =
          frame->height_mm ? metres_from_mm(*frame->height_mm) : check_.rig.cup.bottom() + kLift * frame->fill_m;
      const double pixels = pixels_in_sight(place_of(*frame), height, check_.rig);
      if (pixels >= (frame->cloud.empty() ? kFewestInInterior : kFewestInRegion)) continue;
      hidden.size = std::min(hidden.size, pixels);
      hidden.names.push_back(fmt::format("{} at {}", filling_name(*frame), place_name(*frame)));
    }
    if (!hidden.names.empty()) add(std::move(hidden));
  }

  /// The unit is the same in all sessions: views of one are enough. A table's heights have no desk to learn it from.
  void look_for_bare_desk() {
    double bias = 0.0, cups = 0.0;
    for (const FrameRecord& f : frames_) {
      if (f.cloud.empty()) continue;
      if (f.bare_desk()) return;
      bias += kBias_px * height_per_px_mm(place_of(f), check_.rig), ++cups;
    }
    if (cups > 0.0) add({Lack::bare_desk_views, (check_.rig.unit.map ? kLeftByCalibration : 1.0) * bias / cups});
  }

  void look_for_repeats() {
    std::map<Condition, std::set<PlacementKey>> placements;
    std::map<std::tuple<std::string, double>, std::set<std::pair<int, int>>> pours;
    std::map<std::tuple<std::string, double>, std::string> names;
    for (const FrameRecord& f : frames_) {
      if (f.bare_desk()) continue;
      placements[condition_of(f)].insert(placement_of(f));
      if (f.liquid == "empty") continue;
      pours[{f.liquid, f.fill_m}].emplace(f.session, f.pour);
      names.emplace(std::tuple(f.liquid, f.fill_m), filling_name(f));
    }
    if (placements.empty()) return;
    std::size_t put_down_again = 0;
    for (const auto& [condition, put_down] : placements) put_down_again += put_down.size() - 1;
    if (put_down_again < kFewestReplicates && check_.most_trials < 2) {
      add({Lack::repeats});
    } else {
      if (check_.most_trials < 2 && check_.clouds > 0) add({Lack::trials});
      if (put_down_again == 0) add({Lack::placements});
    }
    Shortfall once{Lack::pours};
    for (const auto& [filling, of] : pours)
      if (of.size() < 2) once.names.push_back(names.at(filling));
    if (!once.names.empty()) add(std::move(once));
  }

  void look_for_contrasts() {
    if (check_.fills_mm.empty()) return;
    if (!check_.fills_mm.contains("empty")) add({Lack::empty_cup});
    Shortfall fills{Lack::fills};
    for (const auto& [liquid, depths] : check_.fills_mm)
      if (liquid != "empty" && depths.size() < 2) fills.names.push_back(liquid);
    if (!fills.names.empty()) add(std::move(fills));
    if (check_.distances_mm.size() < 2) add({Lack::distances});
    if (check_.laterals_mm.size() < 2) add({Lack::laterals});
    if (check_.sessions < 2) add({Lack::sessions});
    const bool is_timed = std::any_of(frames_.begin(), frames_.end(),
                                      [&](const FrameRecord& f) { return f.time_s != frames_.front().time_s; });
    if (!is_timed && frames_.size() > 1) add({Lack::times});
  }

  void look_at_sigmas(const Json& rig) {
    Shortfall unsaid{Lack::stated_sigmas};
    for (const RigValue& value : kRigValues)
      if (!check_.rig.sigma.contains(value.key)) unsaid.names.emplace_back(value.key);
    for (const char* key : {"fill_sigma_mm", "placement_sigma_mm"})
      if (!rig.contains(key)) unsaid.names.emplace_back(key);
    check_.session_mm_stated = rig.contains("session_mm"), check_.session_deg_stated = rig.contains("session_deg");
    if (check_.sessions > 1) {
      if (!check_.session_mm_stated) unsaid.names.emplace_back("session_mm");
      if (!check_.session_deg_stated) unsaid.names.emplace_back("session_deg");
    }
    if (!unsaid.names.empty()) add(std::move(unsaid));
  }

  const std::vector<FrameRecord>& frames_;
  MeasurementCheck& check_;
};

}  // namespace

MeasurementCheck check_measurement(const fs::path& folder) {
  MeasurementCheck check;
  check.rig = read_rig(folder / "rig.json");
  const Table table = read_table(folder / "frames.csv");
  for (const char* column : {"cloud", "ir"}) require_files(table, column, folder);
  const std::vector<FrameRecord> frames = read_frames(table, check.rig, folder);
  CloudChecker clouds(folder, table, frames, check);
  clouds.look();
  clouds.look_at_sizes();
  Checker checker(frames, check);
  checker.count();
  checker.find_lacks(read_json(folder / "rig.json"));
  return check;
}

}  // namespace fathom
