// The paper's first experiment, section VI-A: an empty cup among other things, placed anew 20 times.
#include <fmt/format.h>

#include <array>

#include "core/proportion.h"
#include "paper/figures.h"
#include "paper/random_desks.h"
#include "report/gnuplot_text.h"

namespace fathom {
namespace {

constexpr int kPaperDesks = 20;

/// What the paper does not say and we assume, and what else it might have been.
struct Condition {
  const char* what;
  const char* value;
  const char* patch;  ///< of scenes/clutter/desk.json
};

constexpr std::array<Condition, 12> kConditions{
    {{"as assumed", "3 to 6 things", "{}"},
     {"things beside the cup", "1", R"({"objects": {"number": [1, 1]}})"},
     {"things beside the cup", "2", R"({"objects": {"number": [2, 2]}})"},
     {"things beside the cup", "4", R"({"objects": {"number": [4, 4]}})"},
     {"least gap", "45 mm of 1 to 2",
      R"({"objects": {"number": [1, 2]}, "gap_mm": 45, "touching": 0, "occluding": 0})"},
     {"sensor's height", "500 mm", R"({"sensor": {"height_mm": 500}})"},
     {"sensor's height", "800 mm", R"({"sensor": {"height_mm": 800}})"},
     {"sensor's height", "1000 mm", R"({"sensor": {"height_mm": 1000}})"},
     {"cup", "tapered", R"({"cups": {"kinds": [{"shape": "tapered_cup"}]}})"},
     {"cup", "mug", R"({"cups": {"kinds": [{"shape": "mug"}]}})"},
     {"sensor", "as the device", R"({"sensor": {"model": "xtion_pro_live_device", "noise": null}})"},
     {"sensor", "as the device, 1 thing",
      R"({"sensor": {"model": "xtion_pro_live_device", "noise": null}, "objects": {"number": [1, 1]}})"}}};

/// SAC-IA takes seconds for a cloud, so only the first condition has it.
constexpr std::array<std::string_view, 3> kMethods{"paper", "robust", "sac-ia"};

std::string misses_text(const CupCounts& counts) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < kMisses.size(); ++i)
    texts.push_back(fmt::format("{} {}", counts.missed[i], name_of(kMisses[i])));
  return fmt::format("{}; {} other things taken for a cup", fmt::join(texts, ", "), counts.false_cups);
}

std::string found_text(const CupCounts& counts) { return share_text(counts.found, counts.cups); }

}  // namespace

Figure reproduce_recognition(const ReproduceSettings& settings) {
  const int desks = settings.trials.value_or(kPaperDesks);
  std::vector<std::vector<CupCounts>> all_counts;  // of each condition, of each method
  Progress progress("desk", kConditions.size() * desks, settings.quiet);
  for (const Condition& condition : kConditions) {
    const std::size_t methods = all_counts.empty() ? kMethods.size() : kMethods.size() - 1;
    std::vector<CupCounts>& row = all_counts.emplace_back();
    for (const auto& trials : search_desks(changed_clutter("desk.json", condition.patch),
                                           std::span(kMethods).first(methods), desks, settings.seed, progress))
      row.push_back(counts_of(trials));
  }

  Figure figure{
      .name = "recognition",
      .title = "Cup recognition on random desks",
      .sentence =
          "The printed method finds the cups that stand alone: what is nearer than its 40 mm is merged with them. So "
          "its rate is that of the clutter, of which the paper does not say how much there was. What the sensor's "
          "height "
          "and the cup's shape change, which it does not give either, stands below.",
      .table = Table({"condition", "value", "method", "cups", "recognised", "share", "share_low", "share_high",
                      "merged", "occluded", "refused", "false_cups"})};
  const std::vector<CupCounts>& assumed = all_counts.front();
  figure.facts = {
      {"Proposed method, recognised", share_text(15, 20), found_text(assumed[0])},
      {"SAC-IA, recognised", share_text(4, 20), found_text(assumed[2])},
      {"Our robust method, recognised", "–", found_text(assumed[1])},
      {"Proposed method, why cups were missed", "merged (Fig. 17), occluded (Fig. 18)", misses_text(assumed[0])},
      {"SAC-IA, why cups were missed", "–", misses_text(assumed[2])}};
  Table bars({"condition", "paper", "paper_low", "paper_high", "robust", "robust_low", "robust_high"});
  for (std::size_t i = 0; i < kConditions.size(); ++i) {
    const auto& [what, value, patch] = kConditions[i];
    std::vector<std::string> bar{fmt::format("{}: {}", what, value)};
    for (std::size_t j = 0; j < all_counts[i].size(); ++j) {
      const CupCounts& counts = all_counts[i][j];
      const Interval interval = wilson_95(counts.found, counts.cups);
      const std::array shares{static_cast<double>(counts.found) / counts.cups, interval.low, interval.high};
      std::vector<std::string> row{what, value, std::string(kMethods[j]), fmt::format("{}", counts.cups),
                                   fmt::format("{}", counts.found)};
      for (const double share : shares) row.push_back(fmt::format("{:.4f}", share));
      if (j < 2) bar.insert(bar.end(), row.end() - 3, row.end());
      for (const int missed : counts.missed) row.push_back(fmt::format("{}", missed));
      row.push_back(fmt::format("{}", counts.false_cups));
      figure.table.add(row);
    }
    bars.add(bar);
    if (i > 0)
      figure.facts.push_back({fmt::format("Proposed method, {}: {}", what, value), "–", found_text(all_counts[i][0])});
  }
  write_table(settings.folder / "recognition_bars.csv", bars);
  draw_figure(
      settings, figure,
      fmt::format(
          R"(
set title {}
set ylabel 'share of the cups that are recognised'
set yrange [0:1.05]; set xrange [-0.6:{}.6]; set ytics 0.25
set xtics scale 0 rotate by -35
set bmargin 11; set rmargin 14
set key below horizontal
plot 'recognition_bars.csv' using ($0-0.1):'paper':'paper_low':'paper_high':xtic(1) with yerrorbars pt 7 ps 1.6 lw 2 lc rgb blue title 'method as printed', \
     '' using ($0+0.1):'robust':'robust_low':'robust_high' with yerrorbars pt 5 ps 1.4 lw 2 lc rgb green title 'robust', \
     0.75 with lines lw 1.5 dt 2 lc rgb blue title 'printed: 15/20', \
     'recognition.csv' using (strcol('method') eq 'sac-ia' ? 0.3 : NaN):'share':'share_low':'share_high' with yerrorbars pt 9 ps 1.6 lw 2 lc rgb red title 'SAC-IA', \
     0.20 with lines lw 1.5 dt 2 lc rgb red title 'printed SAC-IA: 4/20')",
          gnuplot_text(fmt::format("Cups recognised on random desks, {} of each kind (95 % intervals), over what "
                                   "the paper does not say",
                                   desks)),
          kConditions.size() - 1));
  return figure;
}

}  // namespace fathom
