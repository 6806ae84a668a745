// fathom diagnose: where model and measurement disagree, which effect explains it, and what is left.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "campaign/next_campaign.h"
#include "core/error.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/json.h"
#include "core/view_page.h"
#include "core/visible_text.h"
#include "diagnosis/decision/diagnosis_json.h"
#include "diagnosis/statistics/evidence.h"
#include "report/cup_shots_json.h"
#include "report/diagnosis_report.h"
#include "report/diagnosis_words.h"
#include "report/gnuplot.h"
#include "report/ray_traced_report.h"
#include "report/shots.h"
#include "report/whole_diagnosis.h"
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
  for (const Mistake& mistake : diagnosis.data.mistakes)
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

std::string rows_text(const Diagnosis& diagnosis, const std::vector<std::string>& notes, const fs::path& output,
                      bool as_json) {
  if (as_json) return json_text(json_from(diagnosis));
  std::string text = on_one_line(answer(diagnosis)) + "\n";
  for (const auto& sentences : {notes, diagnosis.data.warnings})
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

/// A table of a diagnosis, known by the first of its columns: a measurement has a heights.csv of its own.
struct TableFile {
  const char* name;
  std::string_view columns;
};
constexpr std::array kTables{
    TableFile{"map_desk.csv", "x,y,mean_mm"},           TableFile{"map_cup.csv", "x,y,radius,from_deg"},
    TableFile{"map_unseen.csv", "x,y,radius,from_deg"}, TableFile{"map_numbers.csv", "x,y,mean_mm"},
    TableFile{"heights.csv", "number,before_mm"},       TableFile{"shape.csv", "x,y,mean_mm"},
    TableFile{"sessions.csv", "x,before_mm,after_mm"},  TableFile{"residuals.csv", "observable,region"}};

/// Throws Error where a table of somebody else's would be written over, such as the heights.csv of `fathom measure`.
void require_own_tables(const fs::path& folder) {
  for (const TableFile& table : kTables)
    if (const fs::path file = folder / table.name; fs::exists(file) && !is_ours(file, table.columns))
      throw Error(file.string(), "is there already, and of no diagnosis; choose another folder");
}

/// next_1.json and so on, which write_next() writes.
bool is_next_campaign(const std::string& name) {
  constexpr std::string_view kBegin = "next_", kEnd = ".json";
  if (name.size() <= kBegin.size() + kEnd.size() || !name.starts_with(kBegin) || !name.ends_with(kEnd)) return false;
  return std::all_of(name.begin() + kBegin.size(), name.end() - kEnd.size(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

/// Removes what an older diagnosis left, report.json first: a folder with it holds one whole diagnosis. What others
/// have put there stays, and model.json, which is written again and may be what the new one goes on from.
void remove_diagnosis(const fs::path& folder) {
  fs::remove(folder / "report.json");
  remove_if_ours(folder / "report.html", "<title>Fathom: diagnosis</title>");
  remove_if_ours(folder / kShotsFile, kShotsBegin);
  remove_view_page(folder);
  std::vector<fs::path> campaigns;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_next_campaign(entry.path().filename().string()))
      campaigns.push_back(entry.path());
  for (const fs::path& campaign : campaigns) fs::remove(campaign);
  fs::remove(folder / "next.json");
  for (const char* name : {"map", "heights", "shape", "sessions"}) remove_drawing(folder, name);
  for (const TableFile& table : kTables) remove_if_ours(folder / table.name, table.columns);
}

void run_diagnose(const DiagnoseOptions& options, const CommonOptions& common) {
  require_gnuplot();
  require_own_tables(common.output);
  const Json earlier = options.model.empty() ? Json() : read_json(options.model);
  const DiagnosisInput input = read_diagnosis_input({.folders = options.folders,
                                                     .model = options.model,
                                                     .without = options.without,
                                                     .photometric = options.fidelity == "photometric",
                                                     .seed = common.seed},
                                                    common.quiet);
  const FolderOwner owner(common.output);  // what cannot be written shows before the long work
  const WholeDiagnosis whole = diagnose(input, common.quiet);
  std::vector<std::string> names;
  for (const fs::path& folder : options.folders) names.push_back(folder.lexically_normal().string());
  const DiagnosedCampaign campaign{
      .folders = names,
      .observations = whole.observations,
      .shots = shots_of(whole.observations, input.measurement, options.folders, common.output),
      .notes = whole.all_notes(),
      .diagnosis = whole.diagnosis,
      .ray_traced_html = whole.traced ? ray_traced_html(*whole.traced, whole.by_few_rays) : ""};
  const Json provenance = {{"fathom", FATHOM_VERSION},
                           {"measurement", fmt::format("{}", fmt::join(names, " and "))},
                           {"model", options.model.string()},
                           {"without", options.without},
                           {"fidelity", options.fidelity},
                           {"seed", common.seed},
                           {"frames", input.measurement.frames.size()},
                           {"observations", campaign.observations.size()}};
  Json report = diagnosis_report_json(whole);
  report["provenance"] = provenance;
  remove_diagnosis(common.output);
  write_diagnosis_report(common.output, campaign);
  write_cup_shots(common.output, input.measurement, options.folders);
  write_next(common.output, campaign.diagnosis, whole.plans, input.measurement.rig);
  write_json(common.output / "model.json", model_json(earlier, campaign.diagnosis, provenance));
  write_json(common.output / "report.json", report);  // last: its presence says that the diagnosis is complete
  print_text(rows_text(campaign.diagnosis, whole.notes, common.output, common.json));
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
