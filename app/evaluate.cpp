// fathom evaluate: detection rates over clouds whose containers are known.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "app/commands.h"
#include "app/detector_options.h"
#include "app/labelled_clouds.h"
#include "app/results.h"
#include "core/files.h"
#include "core/rows.h"
#include "core/units.h"
#include "core/wilson.h"

namespace fathom {
namespace {

struct EvaluateOptions {
  std::filesystem::path folder;
  std::string method{methods().front().name};
  DeskOptions desk;
  std::filesystem::path config;
};

void add_share(const std::string& name, int hits, int trials, std::vector<Row>& rows) {
  const Interval interval = wilson_95(hits, trials);
  rows.push_back({name, fmt::format("{}/{}", hits, trials)});
  rows.push_back({name + "_low", interval.low});
  rows.push_back({name + "_high", interval.high});
}

/// Half of the values differ from the labels by less, if there are any: one wrong label does not count.
void add_median(const std::string& name, std::vector<double> offs_m, std::vector<Row>& rows) {
  if (offs_m.empty()) return;
  for (double& off : offs_m) off = std::abs(off);
  const auto middle = offs_m.begin() + static_cast<std::ptrdiff_t>(offs_m.size() / 2);
  std::nth_element(offs_m.begin(), middle, offs_m.end());
  rows.push_back({name, mm_from_metres(*middle), "mm"});
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

void run_evaluate(const EvaluateOptions& options, const CommonOptions& common) {
  const Method& method = method_named(options.method);
  DetectorSettings settings = detector_settings(options.config);
  settings.prior = options.desk.prior();
  const LabelledResult result = evaluate_folder(options.folder, method, settings, common.quiet);
  if (!common.output.empty()) {
    make_directory(common.output);
    write_table(common.output / "containers.csv", containers_table(result));
  }
  print_results(common, "evaluation", ".txt", format_rows(summary(result), common.json));
}

}  // namespace

std::function<void()> define_evaluate(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<EvaluateOptions>();
  app.add_option("folder", options->folder, "Clouds with cups_groundtruth.csv beside them")
      ->required()
      ->type_name("DIR");
  add_method_option(app, options->method);
  add_desk_options(app, options->desk);
  app.add_option("--config", options->config, "Parameters of the method and its templates")->type_name("JSON");
  return [options, &common] { run_evaluate(*options, common); };
}

}  // namespace fathom
