#include "report/whole_diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "core/input_policy.h"
#include "core/parallel.h"
#include "diagnosis/decision/decide.h"
#include "diagnosis/decision/diagnosis_json.h"
#include "diagnosis/measurement/cup_in_sight.h"
#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/read_measurement.h"
#include "diagnosis/predict/bookkeeping.h"
#include "diagnosis/predict/predictable.h"
#include "diagnosis/statistics/groups.h"
#include "report/diagnosis_words.h"
#include "report/ray_traced_report.h"
#include "sim/effects/effects_json.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// Candidates of these ids are no more; returns those ids of which there were any.
std::vector<std::string> leave_out(const std::vector<std::string>& ids, std::vector<Candidate>& candidates) {
  std::vector<std::string> left_out;
  for (const std::string& id : ids) {
    const auto is_it = [&](const Candidate& candidate) { return effect_name(candidate.effect).id == id; };
    if (std::erase_if(candidates, is_it) > 0) left_out.push_back(id);
  }
  return left_out;
}

/// report.json's effects have the inverses of their parameters too, where tables do.
void add_inverses(const Diagnosis& diagnosis, Json& report) {
  for (std::size_t i = 0; i < diagnosis.effects.size(); ++i)
    for (const NamedParameter& parameter : shown_parameters(diagnosis.effects[i]))
      report["effects"][diagnosis.data.mistakes.size() + i]["parameters"][parameter.name] = {
          {"value", parameter.value}, {"ci95", {parameter.low95, parameter.high95}}};
}

/// A diagnosis holds some sixteen matrices of all observations at once: what a table of 1 MB makes of itself.
void require_room(const std::vector<Observation>& compared, const fs::path& folder) {
  constexpr std::uint64_t kMatrices = 16;  // from the peaks of 1,000 to 2,500 observations
  const std::uint64_t observations = compared.size();
  require_within_limit((folder / "frames.csv").string(), "",
                       bytes_of({kMatrices, sizeof(double), observations, observations}),
                       fmt::format("covariances between {} observations", observations));
}

bool has_heights(const std::vector<Observation>& observations) {
  return std::any_of(observations.begin(), observations.end(),
                     [](const Observation& o) { return o.observable == "height_mm"; });
}

/// "45 mm of water at distance 300 mm, lateral 20 mm", unless it is among the names already.
void add_condition(const Factors& f, std::vector<std::string>& names) {
  std::string name =
      fmt::format("{} at {}", filling_name(f.liquid, f.fill_mm), place_name(f.distance_mm, f.lateral_mm));
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
}

/// The first few, and how many more there are.
std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t kNamed = 4;
  const std::size_t more = names.size() - std::min(names.size(), kNamed);
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

/// Which heights in cups were not compared, why, and what would help; nothing where all were, or where there are no
/// cups.
std::string on_missing_heights(const Measurement& measurement, const std::vector<Observation>& compared) {
  constexpr std::string_view kRemedy =
      "Cups that stand nearer to the sensor's foot, more in the middle, or are fuller show more of their inside.";
  std::set<std::string> placements, compared_placements;
  for (const Observation& o : compared)
    if (o.observable == "height_mm") compared_placements.insert(placement_key(o));
  std::vector<std::string> missing;  // conditions
  std::size_t count = 0;
  for (const Observation& o : measurement.observations) {
    const Factors& f = o.factors;
    if (!has_cup(f) || f.within_mm || !placements.insert(placement_key(o)).second) continue;
    if (compared_placements.contains(placement_key(o))) continue;
    ++count;
    add_condition(f, missing);
  }
  if (missing.empty()) return {};
  if (compared_placements.empty())
    return fmt::format("No height in a cup could be compared: {}. {}",
                       has_heights(measurement.observations)
                           ? "all that is seen in cups lies in the shadows of their walls or near these, as the model "
                             "has them"
                           : "too few pixels show the inside of a cup",
                       kRemedy);
  return fmt::format(
      "In {} of {} placements no height in the cup is compared: {}. By the model too little of the cup's inside is "
      "seen there. {}",
      count, placements.size(), some_of(std::move(missing)), kRemedy);
}

/// Where what is seen in cups is hardly one surface.
std::string on_strays(const std::vector<Observation>& compared) {
  std::vector<std::string> where;
  double most = 0.0;
  for (const Observation& o : compared) {
    if (o.observable != "height_mm" || o.stray_share <= kMostStray) continue;
    add_condition(o.factors, where);
    most = std::max(most, o.stray_share);
  }
  if (where.empty()) return {};
  return fmt::format(
      "Many heights lie more than 6 mm from the median of their part of the cup, up to {:.0f} % of them: {}. Waves do "
      "that, and views that show two surfaces. Which of them a device keeps is not predicted, so these parts hardly "
      "count.",
      100.0 * most, some_of(std::move(where)));
}

/// What it costs that the bare desk was not seen where cups stand.
std::string on_bare_desks(const Measurement& measurement, const Predictor& predictor) {
  constexpr double kWorthSaying = 1.5;  // times less
  const auto is_bare = [](const FrameRecord& f) { return f.bare_desk() && !f.cloud.empty(); };
  if (std::any_of(measurement.frames.begin(), measurement.frames.end(), is_bare)) return {};
  const auto known = predictor.unit_knowledge();
  if (!known || known->now_px < kWorthSaying * known->with_bare_desks_px) return {};
  double sum_mm = 0.0, cups = 0.0;
  for (const FrameRecord& f : measurement.frames)
    if (!f.bare_desk()) sum_mm += height_per_px_mm({f.lateral_m, f.distance_m}, measurement.rig), ++cups;
  const double mm_per_px = sum_mm / std::max(cups, 1.0);
  return fmt::format(
      "No view shows the bare desk, so the sensor's own bias where cups stand is known to {:.2f} mm only. Views "
      "without a cup, three in each session, would bring that to {:.2f} mm.",
      mm_per_px * known->now_px, mm_per_px * known->with_bare_desks_px);
}

}  // namespace

DiagnosisInput read_diagnosis_input(const DiagnosisSettings& settings, bool quiet) {
  DiagnosisInput input{.settings = settings,
                       .model_effects = settings.model.empty() ? Json::array() : effects_of_model(settings.model),
                       .measurement = read_measurements(settings.folders, quiet),
                       .physics = {},
                       .not_looked_for = {}};
  Measurement& measurement = input.measurement;
  require_room(predictable(measurement.observations), settings.folders.front());
  put_bookkeeping_right(input.model_effects, input.rig_file(), measurement);
  input.physics = physics_of(measurement, input.model_effects, input.rig_file(), {}, quiet);
  if (std::string note = on_missing_heights(measurement, input.physics.evidence.observations); !note.empty())
    measurement.notes.push_back(std::move(note));
  if (std::string note = on_strays(input.physics.evidence.observations); !note.empty())
    measurement.notes.push_back(std::move(note));
  if (std::string note = on_bare_desks(measurement, *input.physics.predictor); !note.empty())
    measurement.notes.push_back(std::move(note));
  input.not_looked_for = leave_out(settings.without, input.physics.evidence.candidates);
  return input;
}

WholeDiagnosis diagnose(const DiagnosisInput& input, bool quiet) {
  const Physics& physics = input.physics;
  const std::vector<MeasurementPlan> plans = possible_plans(input.measurement);
  const Designs designs = [&](const std::vector<std::string>& effects) {
    std::vector<Design> result(plans.size());
    parallel_items(static_cast<int>(plans.size()), [&](int i) {
      result[i] = design_of(plans[i], input.measurement, effects, input.model_effects, input.rig_file());
    });
    return result;
  };
  DecisionSettings settings;
  settings.seed = input.settings.seed;
  const Diagnosis by_few_rays = decide(physics.evidence, physics.predict, designs, settings);
  WholeDiagnosis whole{.observations = physics.evidence.observations,
                       .diagnosis = by_few_rays,
                       .traced = {},
                       .by_few_rays = by_few_rays,
                       .notes = input.measurement.notes,
                       .not_covered = {},
                       .plans = plans};
  if (input.settings.photometric && by_few_rays.verdict != Verdict::insufficient) {
    whole.traced = ray_traced_diagnosis(physics, by_few_rays, designs, settings, quiet);
    whole.observations = whole.traced->observations;
    whole.diagnosis = whole.traced->diagnosis;
  }
  if (std::string beside = beside_words(whole.diagnosis.departures); !beside.empty())
    whole.notes.push_back(std::move(beside));
  if (!physics.unseen.empty())
    whole.not_covered.push_back(
        fmt::format("These measurements neither show nor exclude {}.", effect_list(physics.unseen, "or")));
  if (!input.not_looked_for.empty())
    whole.not_covered.push_back(fmt::format("Not looked for: {}.", effect_list(input.not_looked_for, "and")));
  return whole;
}

std::vector<std::string> WholeDiagnosis::all_notes() const {
  std::vector<std::string> all = notes;
  all.insert(all.end(), not_covered.begin(), not_covered.end());
  return all;
}

Json diagnosis_report_json(const WholeDiagnosis& whole) {
  Json report = json_from(whole.diagnosis);
  add_inverses(whole.diagnosis, report);
  if (whole.traced) add_ray_traced(*whole.traced, whole.by_few_rays, report);
  report["answer"] = answer(whole.diagnosis);
  report["notes"] = whole.all_notes();
  return report;
}

}  // namespace fathom
