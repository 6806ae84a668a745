#include "diagnosis/measurement/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "core/error.h"
#include "core/input_policy.h"
#include "core/median.h"
#include "core/units.h"
#include "detector/quiet_pcl.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/sensed_frame.h"
#include "diagnosis/statistics/sufficiency.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

using Condition = std::tuple<std::string, double, double, double>;

Condition condition_of(const FrameRecord& f) { return {f.liquid, f.fill_m, f.distance_m, f.lateral_m}; }

fs::path cloud_path(const Table& table, std::size_t row, const fs::path& folder) {
  return path_named_in((folder / "frames.csv").string(), table.place(row, "cloud"), table.text(row, "cloud"));
}

/// read_frames() would tell of the first missing file alone.
void require_clouds(const Table& table, const fs::path& folder) {
  if (!table.has("cloud")) return;
  std::vector<std::size_t> missing, empty;
  std::size_t named = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "cloud").empty()) continue;
    ++named;
    std::error_code problem;
    const fs::path cloud = cloud_path(table, row, folder);
    if (!fs::is_regular_file(cloud, problem))
      missing.push_back(row);
    else if (fs::file_size(cloud, problem) == 0)
      empty.push_back(row);
  }
  const auto fail = [&](const std::vector<std::size_t>& rows, const char* what) {
    if (rows.empty()) return;
    const std::string file = cloud_path(table, rows.front(), folder).string();
    table.fail(rows.front(), "cloud",
               fmt::format("{} {}{}", what, file,
                           rows.size() > 1 ? fmt::format(", and {} more of {} clouds", rows.size() - 1, named) : ""));
  };
  fail(missing, "there is no file");
  fail(empty, "there is nothing in");
}

std::string place_name(const FrameRecord& f) {
  return fmt::format("distance {:g} mm, lateral {:g} mm", mm_from_metres(f.distance_m), mm_from_metres(f.lateral_m));
}

std::string filling_name(const FrameRecord& f) {
  return f.liquid == "empty" ? f.liquid : fmt::format("{:g} mm of {}", mm_from_metres(f.fill_m), f.liquid);
}

/// Pixels in which camera and projector see what is looked at in the cup. A clear liquid lifts the bottom by a third of
/// its depth; what is turbid is seen from farther still.
double pixels_in_sight(const FrameRecord& frame, const LaboratoryRig& rig) {
  constexpr double kLift = 1.0 / 3.0;
  constexpr int kAcross = 30;
  const double height = rig.cup.bottom() + kLift * frame.fill_m, radius = interior_radius(rig.cup);
  const double opening = rig.cup.inner.back().x(), to_rim = (rig.cup.height() - height) / (rig.height_m - height);
  const Eigen::Isometry3d camera_from_desk =
      desk_from_camera(plane_from({rig.height_m, rig.pitch_rad, rig.roll_rad})).inverse();
  const Eigen::Vector2d camera(-frame.lateral_m - 0.5 * rig.baseline_m, -frame.distance_m);  // from the axis
  const Eigen::Vector2d projector = camera + Eigen::Vector2d(rig.baseline_m, 0.0);
  const double side = 2.0 * radius / kAcross;
  double pixels = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int k = 0; k < kAcross; ++k) {
      const Eigen::Vector2d at((i + 0.5) * side - radius, (k + 0.5) * side - radius);
      const auto passes = [&](const Eigen::Vector2d& from) { return (at + to_rim * (from - at)).norm() < opening; };
      if (at.norm() > radius || !passes(camera) || !passes(projector)) continue;
      const Eigen::Vector2d from_foot = at - camera;
      const double depth = (camera_from_desk * Eigen::Vector3d(from_foot.x(), from_foot.y(), height)).z();
      pixels += rig.focal_px * rig.focal_px * side * side * (rig.height_m - height) / std::pow(depth, 3);
    }
  return pixels;
}

/// How many mm of height a unit's own bias is where this cup stands: 0.1 px of disparity, the mean of measured desks
/// (0.097 px rms, a plane taken off).
double bias_mm(const FrameRecord& frame, const LaboratoryRig& rig) {
  constexpr double kBias_px = 0.1;
  const Eigen::Vector3d camera_to_bottom(frame.lateral_m + 0.5 * rig.baseline_m, frame.distance_m,
                                         rig.cup.bottom() - rig.height_m);
  const double depth = camera_to_bottom.y() * std::cos(rig.pitch_rad) - camera_to_bottom.z() * std::sin(rig.pitch_rad);
  const double too_deep = kBias_px * depth * depth / (rig.focal_px * rig.baseline_m);
  return mm_from_metres(too_deep * -camera_to_bottom.z() / depth);
}

class Checker {
 public:
  Checker(const fs::path& folder, const Table& table, MeasurementCheck& check)
      : folder_(folder), table_(table), check_(check), frames_(read_frames(table, check.rig, folder)) {}

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
      pours.emplace(f.session, f.pour, f.liquid, f.fill_m);
      ++placements[placement_of(f)];
    }
    check_.frames = frames_.size(), check_.sessions = sessions.size(), check_.pours = pours.size();
    check_.placements = placements.size();
    for (const auto& [key, trials] : placements) {
      check_.fewest_trials = check_.fewest_trials == 0 ? trials : std::min(check_.fewest_trials, trials);
      check_.most_trials = std::max(check_.most_trials, trials);
    }
  }

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
      const Cloud cloud = read(row);
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
    require_few(silent, "cloud",
                "show no desk where rig.json says it is, must be in metres in the camera's frame: x "
                "right, y down, z forward");
    require_few(bare, "distance_mm",
                "show the bare desk where distance_mm and lateral_mm say the cup is, must be the "
                "places of the cup's axis in mm");
    compare_pose(height_mm, pitch_deg, roll_deg);
    if (!silent.empty()) add({Lack::desk_in_sight, 0.0, names_of(silent)});
    if (!bare.empty()) add({Lack::cup_in_sight, 0.0, names_of(bare)});
    if (count > 0 && !is_bright) add({Lack::brightness});
  }

  void find_lacks() {
    std::set<Condition> conditions;
    for (const FrameRecord& f : frames_) conditions.insert(condition_of(f));
    if (conditions.size() < kFewestConditions) add({Lack::conditions, static_cast<double>(conditions.size())});
    look_at_places();
    look_into_cups();
    look_at_sizes();
    if (check_.heights > 0) add({Lack::clouds, static_cast<double>(check_.heights)});
    look_for_bare_desk();
    look_for_repeats();
    look_for_contrasts();
    look_at_sigmas();
    std::stable_sort(check_.lacks.begin(), check_.lacks.end(),
                     [](const Shortfall& a, const Shortfall& b) { return a.lack < b.lack; });
  }

 private:
  void add(Shortfall shortfall) { check_.lacks.push_back(std::move(shortfall)); }

  std::vector<std::string> names_of(const std::vector<std::size_t>& rows) const {
    std::vector<std::string> names;
    for (const std::size_t row : rows) names.push_back(frames_[row].frame);
    return names;
  }

  Cloud read(std::size_t row) const {
    try {
      return read_frame_cloud(frames_[row], folder_);
    } catch (const Error& problem) {
      table_.fail(row, "cloud", problem.what());
    }
  }

  /// As a diagnosis does where it is most of all clouds.
  void require_few(const std::vector<std::size_t>& rows, const char* column, const char* what) const {
    if (2 * rows.size() > check_.clouds_read)
      table_.fail(rows.front(), column,
                  fmt::format("{} of {} clouds that were looked at {}", rows.size(), check_.clouds_read, what));
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

  /// Once for each place.
  void look_at_places() {
    std::map<std::pair<double, double>, const FrameRecord*> places;
    for (const FrameRecord& f : frames_)
      if (!f.bare_desk()) places.emplace(std::pair(f.distance_m, f.lateral_m), &f);
    Shortfall cut{Lack::cup_in_image, 1.0};
    for (const auto& [place, frame] : places) {
      const double share = share_in_image(*frame, check_.rig);
      if (share < 1.0) cut.size = std::min(cut.size, share), cut.names.push_back(place_name(*frame));
    }
    if (!cut.names.empty()) add(std::move(cut));
  }

  /// Once for each condition that has clouds.
  void look_into_cups() {
    std::map<Condition, const FrameRecord*> conditions;
    for (const FrameRecord& f : frames_)
      if (!f.bare_desk() && !f.cloud.empty()) conditions.emplace(condition_of(f), &f);
    Shortfall hidden{Lack::inside_in_sight, kFewestInRegion};
    for (const auto& [condition, frame] : conditions) {
      const double pixels = pixels_in_sight(*frame, check_.rig);
      if (pixels >= kFewestInRegion) continue;
      hidden.size = std::min(hidden.size, pixels);
      hidden.names.push_back(fmt::format("{} at {}", filling_name(*frame), place_name(*frame)));
    }
    if (!hidden.names.empty()) add(std::move(hidden));
  }

  /// A copy that broke off leaves a part of a file. Without rows clouds are of many sizes.
  void look_at_sizes() {
    constexpr double kPart = 0.5;  // of the median
    std::vector<double> sizes;
    std::vector<std::size_t> rows, short_ones;
    for (std::size_t row = 0; row < frames_.size(); ++row) {
      if (frames_[row].cloud.empty()) continue;
      std::error_code problem;
      sizes.push_back(static_cast<double>(fs::file_size(cloud_path(table_, row, folder_), problem)));
      rows.push_back(row);
    }
    if (sizes.empty() || check_.height <= 1) return;
    const double usual = median(sizes);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (sizes[i] < kPart * usual) short_ones.push_back(rows[i]);
    if (!short_ones.empty()) add({Lack::whole_clouds, 0.0, names_of(short_ones)});
  }

  void look_for_bare_desk() {
    std::set<int> all, with;
    double bias = 0.0;
    std::size_t cups = 0;
    for (const FrameRecord& f : frames_) {
      if (check_.clouds > 0 && f.cloud.empty()) continue;
      all.insert(f.session);
      if (f.bare_desk()) with.insert(f.session);
      if (!f.bare_desk()) bias += bias_mm(f, check_.rig), ++cups;
    }
    if (check_.clouds == 0 || cups == 0) return;  // a table's heights have no desk pixels to learn from
    Shortfall without{Lack::bare_desk_views, bias / static_cast<double>(cups)};
    for (const int session : all)
      if (!with.contains(session)) without.names.push_back(fmt::format("{}", session));
    // The unit is the same in all sessions.
    if (with.empty()) add(std::move(without));
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
    const bool put_down_again =
        std::any_of(placements.begin(), placements.end(), [](const auto& p) { return p.second.size() > 1; });
    if (!put_down_again && check_.most_trials < 2) {
      add({Lack::repeats});
    } else {
      if (check_.most_trials < 2 && check_.clouds > 0) add({Lack::trials});
      if (!put_down_again) add({Lack::placements});
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

  void look_at_sigmas() {
    constexpr std::array kOfRig{"height_mm", "pitch_deg",           "roll_deg", "baseline_mm",
                                "focal_px",  "disparity_offset_px", "bottom_mm"};
    const Json rig = read_json(folder_ / "rig.json");
    Shortfall unsaid{Lack::stated_sigmas};
    for (const char* key : kOfRig)
      if (!check_.rig.sigma.contains(key)) unsaid.names.emplace_back(key);
    for (const char* key : {"fill_sigma_mm", "placement_sigma_mm"})
      if (!rig.contains(key)) unsaid.names.emplace_back(key);
    if (!unsaid.names.empty()) add(std::move(unsaid));
  }

  const fs::path& folder_;
  const Table& table_;
  MeasurementCheck& check_;
  std::vector<FrameRecord> frames_;
};

}  // namespace

MeasurementCheck check_measurement(const fs::path& folder) {
  MeasurementCheck check;
  check.rig = read_rig(folder / "rig.json");
  const Table table = read_table(folder / "frames.csv");
  require_clouds(table, folder);
  Checker checker(folder, table, check);
  checker.count();
  checker.look();
  checker.find_lacks();
  return check;
}

}  // namespace fathom
