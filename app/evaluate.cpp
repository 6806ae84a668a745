// fathom evaluate: detection rates over random desks, and over clouds whose containers are known.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>

#include "app/commands.h"
#include "app/evaluate.h"
#include "app/options.h"
#include "app/print.h"
#include "app/results.h"
#include "core/files.h"
#include "core/input_record.h"
#include "core/median.h"
#include "core/rows.h"
#include "core/units.h"
#include "detector/settings_json.h"
#include "report/gnuplot.h"
#include "trials/failure_gallery.h"
#include "trials/labelled_clouds.h"
#include "trials/random_desk.h"
#include "trials/rates.h"
#include "trials/trial_tables.h"

namespace fathom {
namespace {

struct EvaluateOptions {
  std::string what;  ///< an experiment, or a folder
  std::string method{methods().front().name};
  DeskOptions desk;
  std::filesystem::path config;
  std::filesystem::path clutter;
  std::optional<int> trials;
  std::string shard{kWhole};
};

/// The paper's experiments on random desks.
struct Experiment {
  std::string_view name, clutter;
  bool by_filling;
  int trials;
};
constexpr std::array kExperiments{Experiment{"recognition", "desk.json", false, 20},
                                  Experiment{"liquid", "liquids.json", true, 10}};

/// The median distance from the labels, if there are any: a single wrong label hardly moves it.
void add_median(const std::string& name, std::vector<double> offs_m, std::vector<Row>& rows) {
  if (offs_m.empty()) return;
  for (double& off : offs_m) off = std::abs(off);
  rows.push_back({name, mm_from_metres(median(std::move(offs_m))), "mm"});
}

std::vector<Row> summary(const LabelledResult& result) {
  int cups = 0, found = 0, others = 0, refused = 0;
  std::vector<double> radius_offs, floor_offs;
  std::vector<Row> failures;
  const auto fail = [&](const std::string& what) {
    failures.push_back({fmt::format("failure{}", failures.size()), what});
  };
  for (const LabelledContainer& one : result.containers) {
    if (!one.on_desk) continue;
    const std::string name = fmt::format("{} {} {}", one.scene, one.labels, one.object);
    (one.is_cup ? cups : others) += 1;
    if (one.is_cup && one.found)
      ++found;
    else if (one.is_cup)
      fail(fmt::format("{}: not found{}{}", name, one.reason.empty() ? "" : ": ", one.reason));
    else if (!one.found)
      ++refused;
    else
      fail(name + ": taken for a cup");
    if (one.is_cup && one.found && one.radius_m)
      radius_offs.push_back(one.found->candidate.circle->radius_m - *one.radius_m);
    if (one.seen_floor_m && one.floor_m && one.object == "pot_open")  // bowls have no level floor
      floor_offs.push_back(*one.seen_floor_m - *one.floor_m);
  }
  for (const std::string& place : result.unlabelled) fail(place + ": a cup where nothing is labelled");

  std::vector<Row> rows{{"scenes", static_cast<double>(result.scenes)}};
  add_share("cups_found", found, cups, rows);
  add_share("others_refused", refused, others, rows);
  rows.push_back({"unlabelled_cups", static_cast<double>(result.unlabelled.size())});
  add_median("radius_median_off", radius_offs, rows);
  add_median("floor_median_off", floor_offs, rows);
  rows.insert(rows.end(), failures.begin(), failures.end());
  return rows;
}

/// DIR/templates and a configuration with them, by which `fathom detect` sees a failure as the trial did.
void keep_templates(const std::filesystem::path& folder, const ClutterEvaluation& evaluation) {
  Json config = evaluation.config.is_null() ? Json::object() : evaluation.config;
  make_directory(folder / "templates");
  remove_leftovers(folder / "templates");
  for (const CupTemplate& cup : evaluation.detector.templates) {
    save_template(folder / "templates", cup);
    config["templates"].push_back("templates/" + cup.name + ".json");
  }
  write_json(folder / "detector.json", config);
}

void run_experiment(const Experiment& experiment, const EvaluateOptions& options, const CommonOptions& common) {
  if (options.desk.given) throw UsageError("--height-mm and --pitch-deg stand in the clutter file of random desks");
  const InputRecord inputs;
  const std::filesystem::path file =
      options.clutter.empty() ? data_directory() / "clutter" / experiment.clutter : options.clutter;
  ClutterEvaluation evaluation{.clutter = read_clutter_spec(file),
                               .config = options.config.empty() ? Json() : read_json(options.config),
                               .by_filling = experiment.by_filling,
                               .trials = options.trials.value_or(experiment.trials),
                               .method = &method_named(options.method),
                               .detector = read_detector_settings(options.config)};
  const bool own_templates = !evaluation.config.contains("templates");
  if (own_templates) evaluation.detector.templates = templates_of(evaluation.clutter);
  std::optional<TrialFolder> folder;
  if (!common.output.empty()) {
    require_gnuplot();
    folder.emplace(
        common.output,
        RunIdentity{"evaluate " + options.what, {{"seed", common.seed}, {"method", options.method}}, inputs.files()});
  }
  const std::vector<TrialResult> trials = run_trials(evaluation, common, folder ? &*folder : nullptr);
  if (folder) {
    write_table(common.output / "cups.csv", cups_table(trials));
    write_table(common.output / "fillings.csv", fillings_table(trials));
    write_reliability(common.output, trials);
    write_failure_gallery(common.output, trials);
    if (own_templates) keep_templates(common.output, evaluation);
  }
  const std::string text = format_rows(detection_rates(evaluation.method->name, trials), common.json);
  print_text(text);
  write_results(common, "rates", ".txt", text);
}

void require_no_trials(const EvaluateOptions& options) {
  if (options.trials || !options.clutter.empty())
    throw UsageError("--trials and --clutter are for the experiments recognition and liquid");
}

void run_folder(const EvaluateOptions& options, const CommonOptions& common) {
  require_no_trials(options);
  const Method& method = method_named(options.method);
  DetectorSettings settings = read_detector_settings(options.config);
  settings.prior = options.desk.prior();
  const LabelledResult result = evaluate_folder(options.what, method, settings, common.quiet);
  std::optional<FolderOwner> owner;
  if (!common.output.empty()) {
    owner.emplace(common.output);
    remove_results(common, "evaluation", ".txt");
    write_table(common.output / "containers.csv", containers_table(result));
  }
  const std::string text = format_rows(summary(result), common.json);
  print_text(text);
  write_results(common, "evaluation", ".txt", text);
}

void run_evaluate(const EvaluateOptions& options, const CommonOptions& common) {
  if (options.shard != kWhole && !is_dataset(options.what)) throw UsageError("--shard is for data sets");
  for (const Experiment& experiment : kExperiments)
    if (options.what == experiment.name) return run_experiment(experiment, options, common);
  if (is_dataset(options.what)) {
    if (options.desk.given) throw UsageError("--height-mm and --pitch-deg stand in a data set's labels");
    require_no_trials(options);
    return evaluate_dataset({options.what, options.config, &method_named(options.method), shard_of(options.shard)},
                            common);
  }
  run_folder(options, common);
}

}  // namespace

std::function<void()> define_evaluate(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<EvaluateOptions>();
  app.add_option("what", options->what,
                 "recognition or liquid, the paper's experiments on random desks; a data set of fathom generate; or a "
                 "folder of clouds with cups_groundtruth.csv beside them")
      ->required()
      ->type_name("recognition|liquid|DIR");
  app.add_option("--trials", options->trials, "Random desks; of liquid for each filling (20, 10)")
      ->check(CLI::Range(1, 100000));
  app.add_option("--clutter", options->clutter, "What stands on the desks (scenes/clutter/desk.json, liquids.json)")
      ->type_name("SPEC.json");
  add_shard_option(app, options->shard);
  add_method_option(app, options->method);
  add_desk_options(app, options->desk);
  app.add_option("--config", options->config, "Parameters of the method and its templates")->type_name("JSON");
  return [options, &common] { run_evaluate(*options, common); };
}

}  // namespace fathom
