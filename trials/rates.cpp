#include "trials/rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/files.h"
#include "core/median.h"
#include "core/proportion.h"
#include "report/gnuplot.h"

namespace fathom {
namespace {

bool is_filled(const TrialCup& cup) { return cup.liquid != "empty"; }

std::vector<const TrialCup*> found_cups(const std::vector<TrialResult>& trials) {
  std::vector<const TrialCup*> cups;
  for (const TrialResult& trial : trials)
    for (const TrialCup& cup : trial.cups)
      if (cup.found) cups.push_back(&cup);
  return cups;
}

/// How many of the cups that are `asked` for are `right`.
template <class Asked, class Right>
void add_share_of(const std::string& name, const std::vector<const TrialCup*>& cups, Asked asked, Right right,
                  std::vector<Row>& rows) {
  int hits = 0, all = 0;
  for (const TrialCup* cup : cups)
    if (asked(*cup)) ++all, hits += right(*cup);
  if (all > 0) add_share(name, hits, all, rows);
}

template <class Counts>
void add_count_of(const std::string& name, const std::vector<const TrialCup*>& cups, Counts counts,
                  std::vector<Row>& rows) {
  rows.push_back({name, static_cast<double>(std::count_if(cups.begin(), cups.end(),
                                                          [&](const TrialCup* cup) { return counts(*cup); }))});
}

struct ProbabilityClass {
  int cups = 0, filled = 0;
  double p_sum = 0.0;

  double mean_p() const { return p_sum / cups; }
  double share() const { return static_cast<double>(filled) / cups; }
};

using ProbabilityClasses = std::array<ProbabilityClass, 10>;

ProbabilityClasses classes_of(const std::vector<const TrialCup*>& cups) {
  ProbabilityClasses classes;
  for (const TrialCup* cup : cups) {
    if (!cup->p_liquid) continue;
    const auto index = static_cast<std::size_t>(*cup->p_liquid * static_cast<double>(classes.size()));
    ProbabilityClass& its = classes[std::min(index, classes.size() - 1)];
    ++its.cups;
    its.filled += is_filled(*cup);
    its.p_sum += *cup->p_liquid;
  }
  return classes;
}

void add_calibration(const std::vector<const TrialCup*>& cups, std::vector<Row>& rows) {
  double off = 0.0;
  int count = 0;
  for (const ProbabilityClass& its : classes_of(cups)) {
    if (its.cups == 0) continue;
    off += its.cups * std::abs(its.mean_p() - its.share());
    count += its.cups;
  }
  if (count > 0) rows.push_back({"p_liquid_calibration_error", off / count});
}

void add_levels(const std::vector<const TrialCup*>& cups, std::vector<Row>& rows) {
  const auto error = [](const TrialCup& cup) { return std::abs(*cup.fill_found_mm - cup.fill_mm); };
  const auto told = [](const TrialCup& cup) { return is_filled(cup) && cup.fill_found_mm.has_value(); };
  for (const LiquidKind kind : {LiquidKind::kOpaque, LiquidKind::kTransparent}) {
    double sum = 0.0;
    int count = 0;
    for (const TrialCup* cup : cups)
      if (told(*cup) && cup->kind == name_of(kind)) sum += error(*cup), ++count;
    if (count == 0) continue;
    rows.push_back({fmt::format("fill_mean_absolute_error_{}", name_of(kind)), sum / count, "mm"});
    rows.push_back({fmt::format("fill_mean_absolute_error_{}_cups", name_of(kind)), static_cast<double>(count)});
  }
  constexpr double k95 = 1.96;
  add_share_of(
      "fill_within_95", cups, told, [&](const TrialCup& cup) { return error(cup) <= k95 * *cup.fill_sigma_mm; }, rows);
}

/// So many different depths may be a design. More, or such as never come twice, were drawn evenly: they have no rate
/// each.
constexpr std::size_t kMostDepths = 20;

std::string number(double value) { return fmt::format("{:.4f}", value); }

/// Of recognised cups.
std::vector<Row> liquid_rates(const std::vector<TrialResult>& trials) {
  const std::vector<const TrialCup*> cups = found_cups(trials);
  std::vector<Row> rows;
  const auto unknown = [](const TrialCup& cup) { return cup.liquid_found == "unknown"; };
  const auto sure = [&](const TrialCup& cup) { return is_filled(cup) && !unknown(cup); };
  const auto said_yes = [](const TrialCup& cup) { return cup.liquid_found == "yes"; };
  add_share_of("sensitivity", cups, sure, said_yes, rows);
  std::set<double> depths_mm;
  std::size_t filled = 0;
  for (const TrialCup* cup : cups)
    if (is_filled(*cup)) depths_mm.insert(cup->fill_mm), ++filled;
  if (depths_mm.size() > kMostDepths || (filled > 1 && depths_mm.size() == filled)) depths_mm.clear();
  for (const double depth_mm : depths_mm)
    add_share_of(
        fmt::format("sensitivity_{:g}_mm", depth_mm), cups,
        [&](const TrialCup& cup) { return sure(cup) && cup.fill_mm == depth_mm; }, said_yes, rows);
  add_share_of(
      "specificity", cups, [&](const TrialCup& cup) { return !is_filled(cup) && !unknown(cup); },
      [](const TrialCup& cup) { return cup.liquid_found == "no"; }, rows);
  add_count_of("liquid_unknown", cups, unknown, rows);
  add_calibration(cups, rows);
  const auto kind_known = [&](const TrialCup& cup) {
    return is_filled(cup) && said_yes(cup) && cup.kind_found != "unknown";
  };
  add_share_of(
      "kind_right", cups, kind_known, [](const TrialCup& cup) { return cup.kind_found == cup.kind; }, rows);
  add_count_of(
      "kind_unknown", cups,
      [&](const TrialCup& cup) { return is_filled(cup) && said_yes(cup) && cup.kind_found == "unknown"; }, rows);
  add_levels(cups, rows);
  return rows;
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

void add_share(const std::string& name, int hits, int trials, std::vector<Row>& rows) {
  const Interval interval = wilson_95(hits, trials);
  rows.push_back({name, fmt::format("{}/{}", hits, trials)});
  rows.push_back({name + "_low", interval.low});
  rows.push_back({name + "_high", interval.high});
}

std::vector<Row> detection_rates(std::string_view method, const std::vector<TrialResult>& trials) {
  constexpr double kInSight = 0.3;  // cups of which less is in sight are not asked for
  const CupCounts counts = counts_of(trials);
  int in_sight = 0, found_in_sight = 0;
  for (const TrialResult& trial : trials)
    for (const TrialCup& cup : trial.cups)
      if (cup.visible >= kInSight) ++in_sight, found_in_sight += cup.found;
  std::vector<Row> rows{{"method", std::string(method)}, {"trials", static_cast<double>(trials.size())}};
  add_share("recognised", counts.found, counts.cups, rows);
  add_share("recognised_in_sight", found_in_sight, in_sight, rows);
  for (std::size_t i = 0; i < kMisses.size(); ++i)
    rows.push_back({fmt::format("missed_{}", name_of(kMisses[i])), static_cast<double>(counts.missed[i])});
  add_share("precision", counts.found, counts.found + counts.false_cups, rows);
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

Table reliability_table(const std::vector<TrialResult>& trials) {
  Table table({"p_low", "p_high", "cups", "mean_p", "filled_share", "filled_low", "filled_high"});
  const ProbabilityClasses classes = classes_of(found_cups(trials));
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const ProbabilityClass& its = classes[i];
    if (its.cups == 0) continue;
    const Interval interval = wilson_95(its.filled, its.cups);
    const double width = 1.0 / static_cast<double>(classes.size()), low = width * static_cast<double>(i);
    table.add({number(low), number(low + width), fmt::format("{}", its.cups), number(its.mean_p()), number(its.share()),
               number(interval.low), number(interval.high)});
  }
  return table;
}

void write_reliability(const std::filesystem::path& folder, const std::vector<TrialResult>& trials) {
  const Table table = reliability_table(trials);
  if (table.rows() == 0) {
    remove_drawing(folder, "reliability");
    remove_if_ours(folder / "reliability.csv", "p_low,p_high");
    return;
  }
  write_table(folder / "reliability.csv", table);
  draw(folder, "reliability", R"(
set title 'P(liquid) as told, and the share of such cups that are filled (95 % intervals, numbers of cups)'
set xlabel 'mean P(liquid) of a class'
set ylabel 'share that is filled'
set xrange [-0.02:1.02]; set yrange [-0.02:1.1]; set size square
set key top left reverse Left
plot x with lines lw 1.5 dt 2 lc rgb ink title 'calibrated', \
     'reliability.csv' using 'mean_p':'filled_share':'filled_low':'filled_high' with yerrorbars pt 7 ps 1.6 lw 2 lc rgb blue \
       title 'told', \
     '' using 'mean_p':'filled_high':(sprintf('%d', column('cups'))) with labels offset 0,0.8 textcolor rgb ink notitle)");
}

}  // namespace fathom
