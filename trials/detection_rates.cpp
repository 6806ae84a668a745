#include "trials/detection_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "core/median.h"
#include "trials/liquid_rates.h"
#include "trials/share_rows.h"

namespace fathom {
namespace {

/// Cups of which less is in sight are not asked for.
constexpr double kInSight = 0.3;

int count_of(const std::vector<TrialResult>& trials, const std::function<bool(const TrialCup&)>& is) {
  int count = 0;
  for (const TrialResult& trial : trials)
    count += static_cast<int>(std::count_if(trial.cups.begin(), trial.cups.end(), is));
  return count;
}

/// Nothing where no time was kept.
void add_median(const std::string& name, const std::vector<TrialResult>& trials, double TrialResult::*time,
                std::vector<Row>& rows) {
  std::vector<double> times;
  for (const TrialResult& trial : trials)
    if (trial.*time > 0.0) times.push_back(trial.*time);
  if (!times.empty()) rows.push_back({name, median(std::move(times)), "s"});
}

}  // namespace

std::vector<Row> detection_rates(std::string_view method, const std::vector<TrialResult>& trials) {
  const auto any = [](const TrialCup&) { return true; };
  const auto found = [](const TrialCup& cup) { return cup.found; };
  const auto in_sight = [](const TrialCup& cup) { return cup.visible >= kInSight; };
  int false_cups = 0;
  for (const TrialResult& trial : trials) false_cups += static_cast<int>(trial.false_cups.size());
  std::vector<Row> rows{{"method", std::string(method)}, {"trials", static_cast<double>(trials.size())}};
  add_share("recognised", count_of(trials, found), count_of(trials, any), rows);
  add_share("recognised_in_sight", count_of(trials, [&](const TrialCup& cup) { return found(cup) && in_sight(cup); }),
            count_of(trials, in_sight), rows);
  for (const Miss miss : kMisses)
    rows.push_back({fmt::format("missed_{}", name_of(miss)),
                    static_cast<double>(count_of(trials, [&](const TrialCup& cup) { return cup.miss == miss; }))});
  add_share("precision", count_of(trials, found), count_of(trials, found) + false_cups, rows);
  for (Row& row : liquid_rates(trials)) rows.push_back(std::move(row));
  add_median("shoot_median", trials, &TrialResult::shoot_s, rows);
  add_median("detect_median", trials, &TrialResult::detect_s, rows);
  std::map<std::string, std::vector<double>> stages;  // a trial in which nothing came so far has fewer
  for (const TrialResult& trial : trials)
    for (const auto& [stage, seconds] : trial.stages_s) stages[stage].push_back(seconds);
  for (auto& [stage, seconds] : stages)
    rows.push_back({fmt::format("detect_{}_median", stage), median(std::move(seconds)), "s"});
  return rows;
}

}  // namespace fathom
