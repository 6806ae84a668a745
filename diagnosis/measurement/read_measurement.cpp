#include "diagnosis/measurement/read_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <map>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/units.h"
#include "detector/quiet_pcl.h"
#include "diagnosis/measurement/copies.h"
#include "diagnosis/measurement/desk_bands.h"
#include "diagnosis/measurement/desk_motion.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/places.h"
#include "diagnosis/measurement/rounding.h"
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

/// Of the pixels whose lines of sight pass through the cup's opening; nothing when there are none.
std::optional<double> valid_fraction(const Cloud& cloud, const LaboratoryRig& rig, const Plane& desk,
                                     const Eigen::Vector2d& cup) {
  if (cloud.height <= 1) return std::nullopt;
  const Eigen::Isometry3d to_desk = desk_from_camera(desk);
  const Eigen::Matrix3f turn = to_desk.linear().cast<float>();
  const Eigen::Vector2f axis = axis_from_camera(rig, cup).cast<float>();
  const float fall = static_cast<float>(desk.offset - rig.cup.height()), focal = static_cast<float>(rig.focal_px);
  const float radius = static_cast<float>(std::max(rig.cup.inner.back().x() - kInteriorMargin, 0.0));
  int looked = 0, valid = 0;
  for (int row = 0; row < cloud.height; ++row)
    for (int column = 0; column < cloud.width; ++column) {
      const Eigen::Vector3f sight =
          turn * Eigen::Vector3f((static_cast<float>(column) + 0.5f - 0.5f * static_cast<float>(cloud.width)) / focal,
                                 (static_cast<float>(row) + 0.5f - 0.5f * static_cast<float>(cloud.height)) / focal,
                                 1.0f);
      if (sight.z() >= 0.0f) continue;
      if ((sight.head<2>() * (fall / -sight.z()) - axis).squaredNorm() > radius * radius) continue;
      ++looked;
      valid += cloud.points[static_cast<std::size_t>(row) * cloud.width + column].allFinite();
    }
  if (looked == 0) return std::nullopt;
  return static_cast<double>(valid) / looked;
}

/// With `bias` taken off; without one the desk's cells are read.
FrameReading read_frame(const FrameRecord& frame, const LaboratoryRig& rig, const std::filesystem::path& folder,
                        const BiasField* bias) {
  FrameReading reading;
  if (frame.cloud.empty()) {
    if (frame.height_mm)
      reading.values.push_back({"height_mm", kWholeInterior, *frame.height_mm, frame.points.value_or(0.0)});
    return reading;
  }
  const Cloud cloud = read_frame_cloud(frame, folder);
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
  if (!view.cup) return reading;
  if (const auto valid = valid_fraction(cloud, rig, estimates->desk, *view.cup))
    reading.values.push_back({"valid_fraction", kWholeInterior, *valid});
  return reading;
}

/// Of two frames that cannot be read the first is told of, whichever thread came first.
std::vector<FrameReading> read_frames_of(const Measurement& measurement, const std::filesystem::path& folder,
                                         const Table& table, const BiasField* bias, bool quiet) {
  std::vector<FrameReading> readings(measurement.frames.size());
  std::vector<std::string> problems(readings.size());
  const QuietPcl quiet_pcl;  // its verbosity is global: threads that silence it must all find it silent
  Progress progress("frame", readings.size(), quiet);
  parallel_items(static_cast<int>(readings.size()), [&](int i) {
    try {
      readings[i] = read_frame(measurement.frames[i], measurement.rig, folder, bias);
    } catch (const Error& problem) {
      problems[i] = problem.what();
    }
    progress.step();
  });
  for (std::size_t row = 0; row < problems.size(); ++row)
    if (!problems[row].empty()) table.fail(row, "cloud", problems[row]);
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
  Factors& factors = observation.factors;
  factors.session = frame.session;
  factors.pour = frame.pour;
  factors.placement = frame.placement;
  factors.time_s = time_s;
  factors.stood_s = stood_s;
  factors.liquid = frame.liquid;
  factors.fill_mm = mm_from_metres(frame.fill_m);
  factors.distance_mm = mm_from_metres(frame.distance_m);
  factors.lateral_mm = mm_from_metres(frame.lateral_m);
  factors.region = trials.region;
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

/// Clouds have heights of regions, tables of the whole interior.
void note_rounding(Measurement& measurement) {
  const double rounding = rounding_mm(measurement.frames);
  for (Observation& o : measurement.observations)
    if (o.observable == "height_mm" && o.factors.region == kWholeInterior) o.rounding = rounding;
}

}  // namespace

struct Survey::Content {
  std::filesystem::path folder;
  bool quiet;
  Table table;
  Measurement measurement;
  std::vector<FrameReading> readings;
};

Survey::Survey(const std::filesystem::path& folder, bool quiet)
    : content_(new Content{folder, quiet, read_table(folder / "frames.csv"), {}, {}}) {
  Measurement& measurement = content_->measurement;
  measurement.rig = read_rig(folder / "rig.json");
  measurement.frames = read_frames(content_->table, measurement.rig, folder);
  const auto read = [&] { content_->readings = read_frames_of(measurement, folder, content_->table, nullptr, quiet); };
  read();
  std::vector<StandsElsewhere> elsewhere;
  for (const FrameReading& reading : content_->readings) elsewhere.push_back(reading.stands_elsewhere);
  if (put_places_right(elsewhere, measurement)) read();
}

Survey::~Survey() = default;
Survey::Survey(Survey&&) noexcept = default;

const LaboratoryRig& Survey::rig() const { return content_->measurement.rig; }

int Survey::sessions() const {
  int count = 0;
  for (const FrameRecord& frame : content_->measurement.frames) count = std::max(count, frame.session + 1);
  return count;
}

Desks Survey::desks() const {
  const std::vector<FrameRecord>& frames = content_->measurement.frames;
  Desks desks;
  for (const auto& [key, rows] : rows_by_placement(frames, std::vector<bool>(frames.size()))) {
    const FrameRecord& frame = frames[rows.front()];
    DeskCells& placement = desks[{frame.session, frame.bare_desk(), frame.distance_m, frame.lateral_m}].emplace_back();
    for (const std::size_t row : rows) placement.add(content_->readings[row].cells);
  }
  return desks;
}

Measurement Survey::measure(std::shared_ptr<const UnitBias> unit) && {
  Measurement measurement = std::move(content_->measurement);
  std::vector<FrameReading> readings = std::move(content_->readings);
  const Table& table = content_->table;
  for (std::size_t i = 0; i < readings.size(); ++i)
    measurement.desk_sights.add(measurement.frames[i], readings[i].cells);
  std::vector<CloudPrint> prints;
  for (const FrameReading& reading : readings) prints.push_back(reading.print);
  if (unit) readings = read_frames_of(measurement, content_->folder, table, &unit->field(), content_->quiet);
  measurement.unit = std::move(unit);
  leave_out_misplaced(table, readings, measurement);
  Copies copies = find_copies(measurement.frames, prints);
  std::move(copies.mistakes.begin(), copies.mistakes.end(), std::back_inserter(measurement.mistakes));
  for (const auto& [key, rows] : rows_by_placement(measurement.frames, copies.left_out))
    add_observations(rows, readings, measurement);
  note_rounding(measurement);
  for (Observation& motion : desk_motion(measurement.observations, measurement.rig))
    measurement.observations.push_back(std::move(motion));
  return measurement;
}

std::shared_ptr<const UnitBias> learn_unit(const Desks& desks, bool is_calibrated) {
  const bool is_seen = std::ranges::any_of(desks, [](const auto& scene) {
    return std::ranges::any_of(scene.second, [](const DeskCells& cells) { return !cells.view().cells.empty(); });
  });
  return is_seen ? std::make_shared<const UnitBias>(desks, is_calibrated) : nullptr;
}

Measurement read_measurement(const std::filesystem::path& folder, bool quiet) {
  Survey survey(folder, quiet);
  std::shared_ptr<const UnitBias> unit = learn_unit(survey.desks(), survey.rig().unit.map != nullptr);
  return std::move(survey).measure(std::move(unit));
}

}  // namespace fathom
