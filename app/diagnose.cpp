// fathom diagnose: where model and measurement disagree, which effect explains it, and what is left.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands.h"
#include "app/diagnosis_report.h"
#include "app/diagnosis_words.h"
#include "app/gnuplot.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/rows.h"
#include "diagnosis/measurement/read_measurement.h"
#include "diagnosis/predict/physics.h"
#include "diagnosis/statistics/decide.h"
#include "diagnosis/statistics/diagnosis_json.h"
#include "diagnosis/statistics/effect_name.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct DiagnoseOptions {
  fs::path folder, model;
  std::vector<std::string> without;
};

/// The effects that the model had, then those that were named: the same list as a scene's.
Json model_json(const Json& had, const Diagnosis& diagnosis, const Json& provenance) {
  Json effects = had;
  const bool is_sure = diagnosis.verdict == Verdict::named || diagnosis.verdict == Verdict::named_and_unknown;
  if (is_sure)
    for (const NamedEffect& named : diagnosis.effects) {
      const EffectName name = effect_name(named.name);
      Json effect{{"name", name.id}};
      if (!name.liquid.empty()) effect["liquid"] = name.liquid;
      for (const NamedParameter& parameter : named.parameters) effect[parameter.name] = parameter.value;
      effects.push_back(std::move(effect));
    }
  return {{"effects", effects}, {"provenance", provenance}};
}

std::string rows_text(const Diagnosis& diagnosis, const fs::path& output, bool as_json) {
  if (as_json) return json_from(diagnosis).dump(2) + "\n";
  std::string text = answer(diagnosis) + "\n";
  for (const std::string& warning : diagnosis.warnings) text += "note: " + warning + "\n";
  return text + fmt::format("report: {}\n", (output / "report.html").string());
}

void run_diagnose(const DiagnoseOptions& options, const CommonOptions& common) {
  require_gnuplot();
  const Json had = options.model.empty() ? Json::array() : effects_of_model(options.model);
  Progress progress("diagnose", 3, common.quiet);
  const Measurement measurement = read_measurement(options.folder);
  progress.step();
  Physics physics = physics_of(measurement, had, (options.folder / "rig.json").string());
  std::erase_if(physics.evidence.candidates, [&](const Candidate& candidate) {
    return std::find(options.without.begin(), options.without.end(), effect_name(candidate.effect).id) !=
           options.without.end();
  });
  progress.step();
  DecisionSettings settings;
  settings.seed = common.seed;
  DiagnosedCampaign campaign{.name = options.folder.lexically_normal().string(),
                             .observations = physics.evidence.observations,
                             .notes = measurement.notes,
                             .diagnosis = decide(physics.evidence, physics.predict, {}, settings)};
  progress.step();
  if (!physics.unseen.empty())
    campaign.notes.push_back(fmt::format("These measurements cannot show {}.", effects_words(physics.unseen)));
  if (!physics.not_sought.empty())
    campaign.notes.push_back(fmt::format("Not looked for: {}.", effects_words(physics.not_sought)));
  const Json provenance = {{"fathom", FATHOM_VERSION},
                           {"measurement", campaign.name},
                           {"model", options.model.string()},
                           {"without", options.without},
                           {"seed", common.seed},
                           {"frames", measurement.frames.size()},
                           {"observations", campaign.observations.size()}};
  make_directory(common.output);
  Json report = json_from(campaign.diagnosis);
  report["answer"] = answer(campaign.diagnosis);
  report["notes"] = campaign.notes;
  report["provenance"] = provenance;
  write_diagnosis_report(common.output, campaign);
  write_json(common.output / "next.json", report["next"]);
  write_json(common.output / "model.json", model_json(had, campaign.diagnosis, provenance));
  write_json(common.output / "report.json", report);
  fmt::print("{}", rows_text(campaign.diagnosis, common.output, common.json));
}

}  // namespace

std::function<void()> define_diagnose(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<DiagnoseOptions>();
  app.add_option("folder", options->folder, "Measurement directory: rig.json, frames.csv and clouds")
      ->required()
      ->type_name("DIR");
  app.add_option("--model", options->model, "What is known already: model.json of an earlier diagnosis")
      ->check(CLI::ExistingFile)
      ->type_name("M.json");
  app.add_option("--without", options->without,
                 "Effects that are not considered, e.g. to see what is mistaken for them")
      ->delimiter(',')
      ->check(CLI::IsMember(effect_ids()))
      ->type_name("EFFECT");
  return [options, &common] {
    require_output(common);
    run_diagnose(*options, common);
  };
}

}  // namespace fathom
