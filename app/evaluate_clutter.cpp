#include "app/evaluate_clutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/results.h"
#include "core/median.h"
#include "core/progress.h"
#include "core/rng.h"
#include "trials/liquid_rates.h"
#include "trials/share_rows.h"

namespace fathom {
namespace {

/// Cups of which less is in sight are not asked for.
constexpr double kInSight = 0.3;

std::string trial_name(std::size_t number) { return fmt::format("{:06}", number); }

int count_of(const std::vector<TrialResult>& trials, const std::function<bool(const TrialCup&)>& is) {
  int count = 0;
  for (const TrialResult& trial : trials)
    count += static_cast<int>(std::count_if(trial.cups.begin(), trial.cups.end(), is));
  return count;
}

double median_s(const std::vector<TrialResult>& trials, double TrialResult::*time) {
  std::vector<double> times;
  for (const TrialResult& trial : trials) times.push_back(trial.*time);
  return median(std::move(times));
}

std::string number_text(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : ""; }

}  // namespace

std::vector<TrialResult> run_trials(const ClutterEvaluation& evaluation, const CommonOptions& common,
                                    TrialFolder* folder) {
  const std::size_t conditions = evaluation.by_filling ? evaluation.clutter.fillings.size() : 1;
  std::vector<TrialResult> results;
  Progress progress("trial", conditions * evaluation.trials, common.quiet);
  for (std::size_t condition = 0; condition < conditions; ++condition) {
    ClutterSpec clutter = evaluation.clutter;
    if (evaluation.by_filling) clutter.fillings = {evaluation.clutter.fillings[condition]}, clutter.empty = 0.0;
    for (int i = 0; i < evaluation.trials; ++i) {
      // Each filling has its own numbers, so that more trials leave those there are as they were.
      constexpr std::size_t kMostTrials = 100000;
      const std::size_t number = condition * kMostTrials + i;
      const std::string name = trial_name(number);
      std::optional<TrialResult> result = folder ? folder->kept(name) : std::nullopt;
      if (!result) {
        const Json scene = random_scene(clutter, common.seed, number);
        const TrialShot shot = shoot_trial(scene, clutter.file, Rng(common.seed, number).bits());
        const Trial trial = search_trial(shot, *evaluation.method, evaluation.detector);
        if (folder) folder->keep(name, scene, shot, trial);
        result = trial.result;
      }
      result->name = name;
      results.push_back(*std::move(result));
      progress.step();
    }
  }
  if (folder) folder->finish();
  return results;
}

std::vector<Row> rates(const ClutterEvaluation& evaluation, const std::vector<TrialResult>& trials) {
  const auto any = [](const TrialCup&) { return true; };
  const auto found = [](const TrialCup& cup) { return cup.found; };
  const auto in_sight = [](const TrialCup& cup) { return cup.visible >= kInSight; };
  int false_cups = 0;
  for (const TrialResult& trial : trials) false_cups += static_cast<int>(trial.false_cups.size());
  std::vector<Row> rows{{"method", std::string(evaluation.method->name)},
                        {"trials", static_cast<double>(trials.size())}};
  add_share("recognised", count_of(trials, found), count_of(trials, any), rows);
  add_share("recognised_in_sight", count_of(trials, [&](const TrialCup& cup) { return found(cup) && in_sight(cup); }),
            count_of(trials, in_sight), rows);
  for (const Miss miss : kMisses)
    rows.push_back({fmt::format("missed_{}", name_of(miss)),
                    static_cast<double>(count_of(trials, [&](const TrialCup& cup) { return cup.miss == miss; }))});
  add_share("precision", count_of(trials, found), count_of(trials, found) + false_cups, rows);
  for (Row& row : liquid_rates(trials)) rows.push_back(std::move(row));
  rows.push_back({"shoot_median", median_s(trials, &TrialResult::shoot_s), "s"});
  rows.push_back({"detect_median", median_s(trials, &TrialResult::detect_s), "s"});
  std::map<std::string, std::vector<double>> stages;  // a trial in which nothing came so far has fewer
  for (const TrialResult& trial : trials)
    for (const auto& [stage, seconds] : trial.stages_s) stages[stage].push_back(seconds);
  for (auto& [stage, seconds] : stages)
    rows.push_back({fmt::format("detect_{}_median", stage), median(std::move(seconds)), "s"});
  return rows;
}

Table cups_table(const std::vector<TrialResult>& trials) {
  Table table({"trial", "cup", "x_mm", "y_mm", "visible", "liquid", "fill_mm", "found", "miss", "liquid_found",
               "surface_mm", "kind_found", "fill_found_mm", "fill_sigma_mm", "p_liquid", "why"});
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::string number = fmt::format("{}", i);
    for (const TrialCup& cup : trials[i].cups)
      table.add({number, cup.shape, fmt::format("{:.1f}", cup.position_mm.x()),
                 fmt::format("{:.1f}", cup.position_mm.y()), fmt::format("{:.3f}", cup.visible), cup.liquid,
                 fmt::format("{:g}", cup.fill_mm), cup.found ? "yes" : "no",
                 cup.miss ? std::string(name_of(*cup.miss)) : "", cup.liquid_found, number_text(cup.surface_mm),
                 cup.kind_found, number_text(cup.fill_found_mm), number_text(cup.fill_sigma_mm),
                 number_text(cup.p_liquid), cup.why});
    for (const std::string& name : trials[i].false_cups)
      table.add({number, name, "", "", "", "", "", "false", "", "", "", "", "", "", "", ""});
  }
  return table;
}

Table fillings_table(const std::vector<TrialResult>& trials) {
  struct Tally {
    std::string liquid;
    double fill_mm;
    int cups = 0, recognised = 0, detected = 0;
  };
  std::vector<Tally> fillings;  // in the order of the trials
  for (const TrialResult& trial : trials)
    for (const TrialCup& cup : trial.cups) {
      auto known = std::find_if(fillings.begin(), fillings.end(), [&](const Tally& tally) {
        return tally.liquid == cup.liquid && tally.fill_mm == cup.fill_mm;
      });
      if (known == fillings.end()) known = fillings.insert(known, {cup.liquid, cup.fill_mm});
      ++known->cups;
      known->recognised += cup.found;
      known->detected += cup.liquid_found == "yes";
    }
  Table table({"liquid", "fill_mm", "cups", "recognised", "liquid_detected"});
  for (const Tally& tally : fillings)
    table.add({tally.liquid, fmt::format("{:g}", tally.fill_mm), fmt::format("{}", tally.cups),
               fmt::format("{}", tally.recognised), fmt::format("{}", tally.detected)});
  return table;
}

}  // namespace fathom
