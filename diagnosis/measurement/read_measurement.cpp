#include "diagnosis/measurement/read_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/units.h"
#include "diagnosis/measurement/copies.h"
#include "diagnosis/measurement/desk_motion.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/places.h"
#include "diagnosis/measurement/sensed_frame.h"

namespace fathom {
namespace {

struct FrameReading {
  std::vector<NamedValue> values;
  bool is_bare = false;  ///< the desk is seen where the cup should stand
  StandsElsewhere stands_elsewhere{};
  CloudPrint print;
  std::optional<DeskBands> bands;
  DeskCells cells;
};

std::vector<CloudPrint> prints_of(std::span<const FrameReading> readings) {
  std::vector<CloudPrint> prints;
  for (const FrameReading& reading : readings) prints.push_back(reading.print);
  return prints;
}

/// With `bias` taken off; without one the desk's cells are read.
FrameReading read_frame(const Measurement& measurement, std::size_t row, const std::filesystem::path& folder,
                        const Table& table, const BiasField* bias) {
  const FrameRecord& frame = measurement.frames[row];
  const LaboratoryRig& rig = measurement.rig;
  FrameReading reading;
  if (frame.cloud.empty()) {
    if (frame.height_mm)
      reading.values.push_back({"height_mm", kWholeInterior, *frame.height_mm, frame.points.value_or(0.0)});
    return reading;
  }
  const Cloud cloud = read_frame_cloud(frame, folder, table, row);
  std::vector<SensedPoint> points = sensed_points(cloud, rig);
  if (!bias) reading.print = print_of(points, rig.focal_px);
  FrameView view = view_of(frame);
  view.has_rows = cloud.height > 1;
  points = without_bias(cloud, std::move(points), rig, view, bias);
  const std::optional<FrameEstimates> estimates = estimate_frame(points, rig, view);
  if (!estimates || !is_near(estimates->desk, rig)) return reading;
  if (!bias) reading.stands_elsewhere = stands_elsewhere(points, rig, frame, estimates);
  reading.is_bare = view.cup && shows_desk(*estimates, rig);
  reading.values = named_values(*estimates);
  reading.bands = estimates->desk_bands;
  if (!bias) reading.cells.add(points, estimates->desk, rig, view);
  return reading;
}

/// Of two frames that cannot be read the first is told of, whichever thread came first.
std::vector<FrameReading> read_frames_of(const Measurement& measurement, const std::filesystem::path& folder,
                                         const Table& table, const BiasField* bias, bool quiet) {
  std::vector<FrameReading> readings(measurement.frames.size());
  std::vector<std::string> problems(readings.size());
  Progress progress("frame", readings.size(), quiet);
  parallel_items(static_cast<int>(readings.size()), [&](int i) {
    try {
      readings[i] = read_frame(measurement, i, folder, table, bias);
    } catch (const Error& problem) {
      problems[i] = problem.what();
    }
    progress.step();
  });
  for (const std::string& problem : problems)
    if (!problem.empty()) throw Error(problem);
  return readings;
}

/// The values of one observable over the trials, in the order in which frames first name it.
struct Trials {
  std::string_view observable, region;
  std::vector<double> values;
  double pixels = 0.0;  ///< of all
};

Observation observation_of(const Trials& trials, const FrameRecord& frame, double time_s, double stood_s) {
  const double n = static_cast<double>(trials.values.size());
  Observation observation;
  observation.observable = trials.observable;
  observation.repeats = static_cast<int>(trials.values.size());
  observation.pixels = trials.pixels / n;
  observation.factors = factors_of(frame);
  observation.factors.time_s = time_s;
  observation.factors.stood_s = stood_s;
  observation.factors.region = trials.region;
  for (const double value : trials.values) observation.value += value / n;
  double squares = 0.0;
  for (const double value : trials.values) squares += (value - observation.value) * (value - observation.value);
  if (n > 1.0) observation.repeat_sd = std::sqrt(squares / (n - 1.0));
  return observation;
}

void add_observations(const std::vector<std::size_t>& rows, const std::vector<FrameReading>& readings,
                      Measurement& measurement) {
  std::vector<Trials> all;
  std::vector<DeskBands> bands;
  double time_s = 0.0, stood_s = 0.0;
  for (const std::size_t row : rows) {
    time_s += measurement.frames[row].time_s / static_cast<double>(rows.size());
    stood_s += measurement.frames[row].stood_s / static_cast<double>(rows.size());
    if (readings[row].bands) bands.push_back(*readings[row].bands);
    for (const NamedValue& named : readings[row].values) {
      auto same = std::find_if(all.begin(), all.end(), [&](const Trials& trials) {
        return trials.observable == named.observable && trials.region == named.region;
      });
      if (same == all.end()) same = all.insert(all.end(), {named.observable, named.region, {}});
      same->values.push_back(named.value);
      same->pixels += named.pixels;
    }
  }
  for (const NamedValue& scatter : scatter_values(bands, measurement.rig))
    all.push_back({scatter.observable, scatter.region, {scatter.value}});
  for (const Trials& trials : all)
    measurement.observations.push_back(observation_of(trials, measurement.frames[rows.front()], time_s, stood_s));
}

std::map<PlacementKey, std::vector<std::size_t>> rows_by_placement(const std::vector<FrameRecord>& frames,
                                                                   const std::vector<bool>& left_out) {
  std::map<PlacementKey, std::vector<std::size_t>> rows;
  for (std::size_t row = 0; row < frames.size(); ++row)
    if (!left_out[row]) rows[placement_of(frames[row])].push_back(row);
  return rows;
}

/// "12 of 378 clouds WHAT and do not count: frames 3, 4, … and 7 more". Where it is most of them, the line of the first
/// is an error.
void note_clouds(const Misplaced& what, const std::vector<std::size_t>& rows, std::size_t clouds, const Table& table,
                 Measurement& measurement) {
  if (rows.empty()) return;
  std::vector<std::string> frames;
  for (const std::size_t row : rows) frames.push_back(measurement.frames[row].frame);
  measurement.notes.push_back(fmt::format("{} and do not count: {} {}", finding_of(what, rows, clouds, table),
                                          rows.size() > 1 ? "frames" : "frame", name_list(frames)));
}

/// What shows no desk or no cup is said, and does not count.
void leave_out_misplaced(const Table& table, std::vector<FrameReading>& readings, Measurement& measurement) {
  std::size_t tables = 0, clouds = 0;
  std::vector<std::size_t> silent, bare;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const FrameRecord& frame = measurement.frames[i];
    tables += frame.cloud.empty() && !frame.bare_desk();
    clouds += !frame.cloud.empty();
    if (!frame.cloud.empty() && readings[i].values.empty()) silent.push_back(i);
    if (readings[i].is_bare) bare.push_back(i);
  }
  if (tables > 0)
    measurement.notes.push_back(
        fmt::format("{} of {} frames have a height and no cloud: only mean heights are compared there, which tell few "
                    "effects apart",
                    tables, readings.size()));
  note_clouds(kNoDesk, silent, clouds, table, measurement);
  note_clouds(kNoCup, bare, clouds, table, measurement);
  for (const std::size_t row : bare) {
    readings[row].values.clear();
    readings[row].bands.reset();
  }
}

/// Of each height that has no cloud, 1 σ of the error that rounding makes, if all are rounded to 0.05 mm or more.
/// Clouds have heights of regions, tables of the whole interior.
void note_rounding(Measurement& measurement) {
  constexpr double kSteps_mm[] = {1.0, 0.5, 0.2, 0.1, 0.05};
  constexpr double kSame = 1e-6;  // steps
  std::vector<double> heights_mm;
  for (const FrameRecord& frame : measurement.frames)
    if (frame.cloud.empty() && frame.height_mm) heights_mm.push_back(*frame.height_mm);
  const auto are_rounded_to = [&](double step_mm) {
    return std::ranges::all_of(heights_mm, [&](double height_mm) {
      return std::abs(height_mm / step_mm - std::round(height_mm / step_mm)) < kSame;
    });
  };
  const auto step_mm = std::ranges::find_if(kSteps_mm, are_rounded_to);
  if (heights_mm.empty() || step_mm == std::end(kSteps_mm)) return;
  for (Observation& o : measurement.observations)
    if (o.observable == "height_mm" && o.factors.region == kWholeInterior) o.rounding = *step_mm / std::sqrt(12.0);
}

/// A folder before the unit's bias is known.
struct Survey {
  std::filesystem::path folder;
  bool quiet;
  Table table;
  Measurement measurement;             ///< without observations
  std::vector<FrameReading> readings;  ///< with the bias in them
};

Survey survey_of(const std::filesystem::path& folder, bool quiet) {
  Survey survey{folder, quiet, read_table(folder / "frames.csv"), {}, {}};
  Measurement& measurement = survey.measurement;
  measurement.rig = read_rig(folder / "rig.json");
  measurement.frames = read_frames(survey.table, measurement.rig, folder);
  const auto read = [&] { survey.readings = read_frames_of(measurement, folder, survey.table, nullptr, quiet); };
  read();
  std::vector<StandsElsewhere> elsewhere;
  for (const FrameReading& reading : survey.readings) elsewhere.push_back(reading.stands_elsewhere);
  if (put_places_right(elsewhere, measurement)) read();
  return survey;
}

/// The largest number and one.
int sessions_of(const std::vector<FrameRecord>& frames) {
  int count = 0;
  for (const FrameRecord& frame : frames) count = std::max(count, frame.session + 1);
  return count;
}

/// Sessions are numbered from `first_session` on.
Desks desks_of(const Survey& survey, int first_session) {
  const std::vector<FrameRecord>& frames = survey.measurement.frames;
  Desks desks;
  for (const auto& [key, rows] : rows_by_placement(frames, std::vector<bool>(frames.size()))) {
    const FrameRecord& frame = frames[rows.front()];
    const DeskScene scene{first_session + frame.session, frame.bare_desk(), frame.distance_m, frame.lateral_m};
    DeskCells& placement = desks[scene].emplace_back();
    for (const std::size_t row : rows) placement.add(survey.readings[row].cells);
  }
  return desks;
}

/// Nothing without desks.
std::shared_ptr<const UnitBias> learn_unit(const Desks& desks, bool is_calibrated) {
  const bool is_seen = std::ranges::any_of(desks, [](const auto& scene) {
    return std::ranges::any_of(scene.second, [](const DeskCells& cells) { return !cells.view().cells.empty(); });
  });
  return is_seen ? std::make_shared<const UnitBias>(desks, is_calibrated) : nullptr;
}

/// What the clouds say without the unit's bias.
Measurement measured(Survey survey, std::shared_ptr<const UnitBias> unit) {
  Measurement measurement = std::move(survey.measurement);
  std::vector<FrameReading> readings = std::move(survey.readings);
  for (std::size_t i = 0; i < readings.size(); ++i)
    measurement.desk_sights.add(measurement.frames[i], readings[i].cells);
  const std::vector<CloudPrint> prints = prints_of(readings);
  if (unit) readings = read_frames_of(measurement, survey.folder, survey.table, &unit->field(), survey.quiet);
  measurement.unit = std::move(unit);
  leave_out_misplaced(survey.table, readings, measurement);
  Copies copies = find_copies(measurement.frames, prints);
  std::move(copies.mistakes.begin(), copies.mistakes.end(), std::back_inserter(measurement.mistakes));
  for (const auto& [key, rows] : rows_by_placement(measurement.frames, copies.left_out))
    add_observations(rows, readings, measurement);
  note_rounding(measurement);
  for (Observation& motion : desk_motion(measurement.observations, measurement.rig))
    measurement.observations.push_back(std::move(motion));
  return measurement;
}

void require_same(const LaboratoryRig& rig, const std::filesystem::path& folder, const LaboratoryRig& first,
                  const std::filesystem::path& first_folder) {
  constexpr double kSame = 1e-7;  // [SI] rig.json is written to the nanometre
  const auto differs = [&](const std::string& path) {
    throw Error((folder / "rig.json").string(), path,
                fmt::format("must be as in {}: folders that are looked at together have one rig",
                            (first_folder / "rig.json").string()));
  };
  if (rig.sensor_model != first.sensor_model) differs("/sensor/model");
  if (!(rig.unit == first.unit)) differs("/sensor/unit");
  for (const RigValue& value : kRigValues)
    if (value.of_sensor && !(std::abs(rig.*value.of_sensor - first.*value.of_sensor) <= kSame))
      differs(fmt::format("/sensor/{}", value.key));
  if (!is_same_cup(rig.cup, first.cup)) differs("/cup");
  for (const auto& [name, medium] : rig.liquids)
    if (const auto known = first.liquids.find(name); known != first.liquids.end() && known->second != medium)
      differs(fmt::format("/liquids/{}", name));
}

/// A copy would count as further sessions.
void require_another(const Survey& survey, const Survey& earlier) {
  const std::size_t same = rows_repeated(survey.measurement.frames, prints_of(survey.readings),
                                         earlier.measurement.frames, prints_of(earlier.readings));
  if (2 * same > std::min(survey.readings.size(), earlier.readings.size()))
    throw Error(survey.folder.string(),
                fmt::format("must be another measurement than {}: {} of its {} frames are the same",
                            earlier.folder.string(), same, survey.readings.size()));
}

/// The sessions of `more`, the folder of that number, follow those of `all`.
void append(Measurement more, std::size_t folder, Measurement& all) {
  const int sessions = sessions_of(all.frames);
  for (FrameRecord& frame : more.frames) {
    frame.session += sessions;
    frame.folder = folder;
    all.frames.push_back(std::move(frame));
  }
  for (Observation& observation : more.observations) {
    observation.factors.session += sessions;
    all.observations.push_back(std::move(observation));
  }
  all.desk_sights.add(more.desk_sights);
  all.rig.liquids.insert(more.rig.liquids.begin(), more.rig.liquids.end());
  for (std::string& note : more.notes) all.notes.push_back(std::move(note));
  for (Mistake& mistake : more.mistakes) all.mistakes.push_back(std::move(mistake));
}

}  // namespace

Factors factors_of(const FrameRecord& frame) {
  Factors factors;
  factors.session = frame.session, factors.pour = frame.pour, factors.placement = frame.placement;
  factors.liquid = frame.liquid, factors.fill_mm = mm_from_metres(frame.fill_m);
  factors.distance_mm = mm_from_metres(frame.distance_m), factors.lateral_mm = mm_from_metres(frame.lateral_m);
  return factors;
}

Measurement read_measurements(std::span<const std::filesystem::path> folders, bool quiet) {
  std::vector<Survey> surveys;
  Desks desks;
  int sessions = 0;
  for (const std::filesystem::path& folder : folders) {
    for (const std::filesystem::path& earlier : folders)
      if (&earlier < &folder && std::filesystem::equivalent(earlier, folder))
        throw Error(folder.string(), "is given twice, must be another measurement");
    surveys.push_back(survey_of(folder, quiet));
    require_same(surveys.back().measurement.rig, folder, surveys.front().measurement.rig, folders.front());
    for (std::size_t i = 0; i + 1 < surveys.size(); ++i) require_another(surveys.back(), surveys[i]);
    desks.merge(desks_of(surveys.back(), sessions));
    sessions += sessions_of(surveys.back().measurement.frames);
  }
  const bool is_calibrated = surveys.front().measurement.rig.unit.map != nullptr;
  const std::shared_ptr<const UnitBias> unit = learn_unit(desks, is_calibrated);
  Measurement all = measured(std::move(surveys.front()), unit);
  for (std::size_t i = 1; i < surveys.size(); ++i) append(measured(std::move(surveys[i]), unit), i, all);
  return all;
}

Measurement read_measurement(const std::filesystem::path& folder, bool quiet) {
  return read_measurements({&folder, 1}, quiet);
}

}  // namespace fathom
