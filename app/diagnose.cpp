// fathom diagnose: where model and measurement disagree, which effect explains it, and what is left.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "app/choice_option.h"
#include "app/commands.h"
#include "app/print.h"
#include "app/remove_diagnosis.h"
#include "app/results.h"
#include "campaign/next_campaign.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/input_policy.h"
#include "core/json_text.h"
#include "core/units.h"
#include "core/visible_text.h"
#include "diagnosis/decision/decide.h"
#include "diagnosis/decision/diagnosis_json.h"
#include "diagnosis/measurement/cup_in_sight.h"
#include "diagnosis/measurement/joined.h"
#include "diagnosis/predict/bookkeeping.h"
#include "diagnosis/predict/designs.h"
#include "diagnosis/predict/physics.h"
#include "diagnosis/predict/predictable.h"
#include "diagnosis/statistics/evidence.h"
#include "report/diagnosis_report.h"
#include "report/diagnosis_words.h"
#include "report/gnuplot.h"
#include "report/ray_traced_report.h"
#include "report/shots.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct DiagnoseOptions {
  std::vector<fs::path> folders;
  fs::path model;
  std::vector<std::string> without;
  std::string fidelity = "geometric";
};

/// The effects that the model had, then those that were named: the same list as a scene's. `had` is an earlier
/// model.json or empty.
Json model_json(const Json& had, const Diagnosis& diagnosis, const Json& provenance) {
  Json model{{"effects", Json::array()}, {"provenance", provenance}};
  if (!had.empty()) {
    model["effects"] = had["effects"];
    model["provenance"]["earlier"] = had.value("provenance", Json::object());
  }
  for (const Mistake& mistake : diagnosis.mistakes)
    model["provenance"]["mistakes"].push_back({{"name", mistake.id}, {"sentence", mistake.sentence}});
  const bool is_sure = diagnosis.verdict == Verdict::named || diagnosis.verdict == Verdict::named_and_unknown;
  if (!is_sure) return model;
  std::vector<std::string> parameters;  // of the covariance's rows: the effect's place in the list and the key
  for (const NamedEffect& named : diagnosis.effects) {
    const EffectName name = effect_name(named.name);
    Json effect{{"name", name.id}};
    if (!name.liquid.empty()) effect["liquid"] = name.liquid;
    for (const NamedParameter& parameter : named.parameters) {
      effect[parameter.name] = parameter.value;
      parameters.push_back(fmt::format("/effects/{}/{}", model["effects"].size(), parameter.name));
    }
    model["effects"].push_back(std::move(effect));
    model["provenance"]["named"].push_back(
        {{"effect", named.name}, {"p_discovery", named.p_discovery}, {"p_confirmation", named.p_confirmation}});
  }
  model["covariance"] = {{"parameters", parameters}, {"matrix", diagnosis.parameter_covariance}};
  model["provenance"]["gap"] = json_from(diagnosis)["gap"];
  return model;
}

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
      report["effects"][diagnosis.mistakes.size() + i]["parameters"][parameter.name] = {
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

/// Why no height in a cup was compared, and what would help; nothing where some were, or where there are no cups.
std::string on_missing_heights(const Measurement& measurement, const std::vector<Observation>& compared) {
  const bool has_cups = std::any_of(measurement.frames.begin(), measurement.frames.end(),
                                    [](const FrameRecord& f) { return !f.bare_desk(); });
  if (!has_cups || has_heights(compared)) return {};
  return fmt::format(
      "No height in a cup could be compared: {}. Cups that stand nearer to the sensor's foot, more in the middle, or "
      "are fuller show more of their inside.",
      has_heights(measurement.observations)
          ? "all that is seen in cups lies in the shadows of their walls or near these, as the model has them"
          : "too few pixels show the inside of a cup");
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

std::string rows_text(const Diagnosis& diagnosis, const std::vector<std::string>& notes, const fs::path& output,
                      bool as_json) {
  if (as_json) return json_text(json_from(diagnosis));
  std::string text = on_one_line(answer(diagnosis)) + "\n";
  for (const auto& sentences : {notes, diagnosis.warnings})
    for (const std::string& sentence : sentences) text += "note: " + on_one_line(sentence) + "\n";
  return text + fmt::format("report: {}\n", on_one_line((output / "report.html").string()));
}

/// next.json, and beside it a campaign's file for each measurement that would settle something.
void write_next(const fs::path& folder, const Diagnosis& diagnosis, const std::vector<MeasurementPlan>& plans,
                const LaboratoryRig& rig) {
  Json next = json_from(diagnosis)["next"];
  std::map<std::string, std::string> files;
  for (Json& entry : next) {
    if (!entry["settles"]) continue;
    const std::string name = entry["measurement"];
    const auto [file, is_new] = files.emplace(name, fmt::format("next_{}.json", files.size() + 1));
    entry["campaign"] = file->second;
    if (!is_new) continue;
    for (const MeasurementPlan& plan : plans)
      if (plan.name == name) write_json(folder / file->second, campaign_of(plan, rig));
  }
  write_json(folder / "next.json", next);
}

void run_diagnose(const DiagnoseOptions& options, const CommonOptions& common) {
  require_report(common);
  const Json had = options.model.empty() ? Json::array() : effects_of_model(options.model);
  const Json earlier = options.model.empty() ? Json() : read_json(options.model);
  Measurement measurement = read_measurements(options.folders, common.quiet);
  const std::string rig_file = (options.folders.front() / "rig.json").string();
  require_room(predictable(measurement.observations), options.folders.front());
  put_bookkeeping_right(had, rig_file, measurement);
  Physics physics = physics_of(measurement, had, rig_file, {}, common.quiet);
  if (std::string note = on_missing_heights(measurement, physics.evidence.observations); !note.empty())
    measurement.notes.push_back(std::move(note));
  if (std::string note = on_bare_desks(measurement, *physics.predictor); !note.empty())
    measurement.notes.push_back(std::move(note));
  const FolderOwner owner(common.output);  // what cannot be written shows before the long work
  const std::vector<std::string> not_looked_for = leave_out(options.without, physics.evidence.candidates);
  DecisionSettings settings;
  settings.seed = common.seed;
  const std::vector<MeasurementPlan> plans = possible_plans(measurement);
  const Designs designs = [&](const std::vector<std::string>& effects) {
    std::vector<Design> result;
    for (const MeasurementPlan& plan : plans) result.push_back(design_of(plan, measurement, effects, had, rig_file));
    return result;
  };
  std::vector<std::string> names;
  for (const fs::path& folder : options.folders) names.push_back(folder.lexically_normal().string());
  DiagnosedCampaign campaign{.name = fmt::format("{}", fmt::join(names, " and ")),
                             .observations = physics.evidence.observations,
                             .shots = {},
                             .notes = measurement.notes,
                             .diagnosis = decide(physics.evidence, physics.predict, designs, settings),
                             .ray_traced_html = {}};
  std::optional<RayTracedDiagnosis> traced;
  const Diagnosis by_few_rays = campaign.diagnosis;
  if (options.fidelity == "photometric" && by_few_rays.verdict != Verdict::insufficient) {
    traced = ray_traced_diagnosis(physics, by_few_rays, designs, settings, common.quiet);
    campaign.observations = traced->observations;
    campaign.diagnosis = traced->diagnosis;
    campaign.ray_traced_html = ray_traced_html(*traced, by_few_rays);
  }
  campaign.shots = shots_of(campaign.observations, measurement, options.folders, common.output);
  if (std::string beside = beside_words(campaign.diagnosis); !beside.empty()) {
    campaign.notes.push_back(beside);
    measurement.notes.push_back(std::move(beside));
  }
  if (!physics.unseen.empty())
    campaign.notes.push_back(fmt::format("These measurements cannot show {}.", effects_words(physics.unseen)));
  if (!not_looked_for.empty())
    campaign.notes.push_back(fmt::format("Not looked for: {}.", effects_words(not_looked_for)));
  const Json provenance = {{"fathom", FATHOM_VERSION},
                           {"measurement", campaign.name},
                           {"model", options.model.string()},
                           {"without", options.without},
                           {"fidelity", options.fidelity},
                           {"seed", common.seed},
                           {"frames", measurement.frames.size()},
                           {"observations", campaign.observations.size()}};
  Json report = json_from(campaign.diagnosis);
  add_inverses(campaign.diagnosis, report);
  if (traced) add_ray_traced(*traced, by_few_rays, report);
  report["answer"] = answer(campaign.diagnosis);
  report["notes"] = campaign.notes;
  report["provenance"] = provenance;
  remove_diagnosis(common.output);
  write_diagnosis_report(common.output, campaign);
  write_next(common.output, campaign.diagnosis, plans, measurement.rig);
  write_json(common.output / "model.json", model_json(earlier, campaign.diagnosis, provenance));
  write_json(common.output / "report.json", report);  // last: its presence says that the diagnosis is complete
  print_text(rows_text(campaign.diagnosis, measurement.notes, common.output, common.json));
}

}  // namespace

std::function<void()> define_diagnose(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<DiagnoseOptions>();
  app.add_option("folder", options->folders,
                 "Measurement directories: rig.json, frames.csv and clouds; further ones are later sessions of one rig")
      ->required()
      ->type_name("DIR");
  app.add_option("--model", options->model, "What is known already: model.json of an earlier diagnosis")
      ->check(CLI::ExistingFile)
      ->type_name("M.json");
  app.add_option("--without", options->without,
                 "Effects that are not considered, e.g. to see what is mistaken for them")
      ->delimiter(',')
      ->check(one_of("effect", effect_ids()))
      ->type_name("EFFECT");
  app.add_option("--fidelity", options->fidelity,
                 "What predicts: geometric (some hundred rays a condition), or after that photometric (whole simulated "
                 "images of what is left, minutes)")
      ->check(one_of("fidelity", {"geometric", "photometric"}))
      ->capture_default_str();
  return [options, &common] { run_diagnose(*options, common); };
}

}  // namespace fathom
