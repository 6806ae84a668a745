// The paper's second experiment, Table I: 16 contents of a cup among other things, each placed anew 10 times.
#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "paper/figures.h"
#include "paper/random_desks.h"
#include "report/gnuplot_text.h"

namespace fathom {
namespace {

constexpr int kTableDesks = 10;

/// A row of the printed table, each of 10.
struct PrintedRow {
  int recognised, liquid;
};

/// In the order of the fillings of scenes/clutter/liquids.json: empty; water, barley tea, orange juice, tomato juice
/// and milk tea with 10, 20 and 30 mm.
constexpr std::array<PrintedRow, 16> kPrinted{{{8, 1},
                                               {7, 7},
                                               {8, 8},
                                               {7, 7},
                                               {8, 8},
                                               {7, 7},
                                               {7, 7},
                                               {7, 7},
                                               {7, 7},
                                               {7, 7},
                                               {7, 7},
                                               {8, 8},
                                               {7, 7},
                                               {7, 7},
                                               {7, 7},
                                               {7, 7}}};

constexpr std::array<std::string_view, 2> kTableMethods{"paper", "robust"};

std::string label_of(const Json& filling) {
  if (filling.empty()) return "empty";
  return fmt::format("{} {:g} mm", filling["liquid"].get<std::string>(), filling["fill_mm"].get<double>());
}

/// Of one kind of desk: what came of each filling by each method.
using TableCounts = std::vector<std::array<CupCounts, kTableMethods.size()>>;

TableCounts fill_in(const ClutterSpec& clutter, int desks, std::uint64_t seed, Progress& progress) {
  TableCounts counts;
  for (std::size_t i = 0; i < clutter.fillings.size(); ++i) {
    ClutterSpec one = clutter;
    one.fillings = {clutter.fillings[i]};
    const auto trials = search_desks(one, kTableMethods, desks, seed + i, progress);
    counts.push_back({counts_of(trials[0]), counts_of(trials[1])});
  }
  return counts;
}

void add_facts(const TableCounts& counts, std::size_t method, const std::string& words, std::vector<Fact>& facts) {
  CupCounts all, filled;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    all += counts[i][method];
    if (i > 0) filled += counts[i][method];
  }
  const CupCounts& empty = counts[0][method];
  const auto told = [](const CupCounts& one) { return one.found - one.unknown; };
  facts.push_back({words + ": cups recognised", share_text(116, 160), share_text(all.found, all.cups)});
  facts.push_back({words + ": of the recognised filled ones called so", share_text(108, 108),
                   share_text(filled.liquid, told(filled))});
  facts.push_back({words + ": of the recognised empty ones called empty", share_text(7, 8),
                   share_text(told(empty) - empty.liquid, told(empty))});
  facts.push_back({words + ": recognised, but its content is unknown", "–", fmt::format("{}", all.unknown)});
}

}  // namespace

Figure reproduce_table1(const ReproduceSettings& settings) {
  const int desks = settings.trials.value_or(kTableDesks);
  const ClutterSpec crowd = changed_clutter("liquids.json", "{}"),
                    one = changed_clutter("liquids.json", R"({"objects": {"number": [1, 1]}})");
  if (crowd.fillings.size() != kPrinted.size())
    throw Error("scenes/clutter/liquids.json", "fillings", "must be the 16 of Table I");
  Progress progress("desk", 2 * kPrinted.size() * desks, settings.quiet);
  const TableCounts among_many = fill_in(crowd, desks, settings.seed, progress),
                    beside_one = fill_in(one, desks, settings.seed, progress);

  Figure figure{
      .name = "table1",
      .title = "Table I: cups recognised and liquids detected",
      .sentence =
          "Whatever fills a cup is to be told from its bottom. How many cups are recognised says how much "
          "stood about, which the paper does not tell. Where a cup is recognised but its bottom is hidden, the "
          "content is unknown.",
      .table = Table({"liquid", "fill_mm", "printed_of", "printed_recognised", "printed_liquid", "things", "method",
                      "cups", "recognised", "liquid_yes", "liquid_unknown"})};
  Table bars({"filling", "printed", "paper", "robust", "printed_liquid", "paper_liquid", "robust_liquid"});
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < kPrinted.size(); ++i) {
    const Json& filling = crowd.fillings[i];
    for (const bool many : {false, true})
      for (std::size_t j = 0; j < kTableMethods.size(); ++j) {
        const CupCounts& counts = (many ? among_many : beside_one)[i][j];
        figure.table.add({filling.value("liquid", "empty"), fmt::format("{:g}", filling.value("fill_mm", 0.0)), "10",
                          fmt::format("{}", kPrinted[i].recognised), fmt::format("{}", kPrinted[i].liquid),
                          many ? "3 to 6" : "1", std::string(kTableMethods[j]), fmt::format("{}", counts.cups),
                          fmt::format("{}", counts.found), fmt::format("{}", counts.liquid),
                          fmt::format("{}", counts.unknown)});
      }
    const auto share = [&](int count) { return fmt::format("{:.3f}", static_cast<double>(count) / desks); };
    const auto& row = beside_one[i];
    labels.push_back(label_of(filling));
    bars.add({labels.back(), fmt::format("{:.1f}", 0.1 * kPrinted[i].recognised), share(row[0].found),
              share(row[1].found), fmt::format("{:.1f}", 0.1 * kPrinted[i].liquid), share(row[0].liquid),
              share(row[1].liquid)});
  }
  add_facts(beside_one, 0, "Method as printed, one thing beside the cup", figure.facts);
  add_facts(among_many, 0, "Method as printed, 3 to 6 things", figure.facts);
  add_facts(beside_one, 1, "Robust, one thing", figure.facts);
  add_facts(among_many, 1, "Robust, 3 to 6 things", figure.facts);
  write_table(settings.folder / "table1_bars.csv", bars);
  draw_figure(settings, figure,
              fmt::format(R"(
set title 'Table I: cups recognised (bars) and liquids detected in them (dots), one thing beside the cup'
set ylabel 'share of the cups'
set yrange [0:1.05]; set xrange [-0.6:15.6]; set ytics 0.25
set grid noxtics
set style data histogram
set style histogram clustered gap 1
set style fill solid 0.9 border lc rgb ink
set boxwidth 0.95
{}set xtics scale 0 rotate by -40
set rmargin 6
set key below horizontal
array colour[3] = [pale, blue, green]
array who[3] = ['printed', 'method as printed, here', 'robust']
plot for [i=1:3] 'table1_bars.csv' using (column(i+1)) lc rgb colour[i] title who[i], \
     for [i=1:3] '' using ($0+(i-2)/4.0):(column(i+4)) with points pt 7 ps 1.1 lc rgb orange title (i == 1 ? 'liquid detected' : ''))",
                          gnuplot_xtics(labels)));
  return figure;
}

}  // namespace fathom
