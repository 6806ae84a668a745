// Fig. 5: what the paper's detector measures in simulated captures.
#include <fmt/format.h>

#include <algorithm>

#include "app/gnuplot.h"
#include "app/reproduce.h"

namespace fathom {
namespace {

constexpr std::array<std::size_t, 3> kWater{1, 2, 3}, kMilkTea{4, 5, 6};

std::string mm(double value) { return fmt::format("{:.3f}", value + 0.0); }

/// The cells that a statement over the distance may rest on.
std::vector<HeightCell> well_seen(const HeightRow& row) {
  std::vector<HeightCell> cells;
  std::copy_if(row.begin(), row.begin() + kSeenDistances, std::back_inserter(cells),
               [](const HeightCell& cell) { return cell.enough(); });
  return cells;
}

bool lower(const HeightCell& a, const HeightCell& b) { return a.mean_mm < b.mean_mm; }

std::pair<double, double> range_over_distance(const HeightRow& row) {
  const std::vector<HeightCell> cells = well_seen(row);
  if (cells.empty()) return {0.0, 0.0};
  const auto [low, high] = std::minmax_element(cells.begin(), cells.end(), lower);
  return {low->mean_mm, high->mean_mm};
}

std::string heights_text(const HeightRow& row) {
  std::vector<std::string> texts;
  for (const HeightCell& cell : well_seen(row)) texts.push_back(fmt::format("{:.1f}", cell.mean_mm));
  return fmt::format("{} mm from 200 mm on", fmt::join(texts, " → "));
}

/// "yes" or "no", and the numbers.
std::string verdict(bool holds, const std::string& numbers) { return (holds ? "yes: " : "no: ") + numbers; }

/// What our assumed geometry leaves of the insides at 500 mm.
std::string few_points_text(const PaperHeights& heights) {
  std::vector<std::string> texts;
  for (std::size_t f = 0; f < kPaperFillings.size(); ++f)
    if (const HeightCell& cell = heights.rows[f][kSeenDistances - 1]; !cell.enough())
      texts.push_back(fmt::format("{} ({:.0f})", kPaperFillings[f].label(), cell.points));
  if (texts.empty()) return "measured";
  return fmt::format(
      "for {} the near wall leaves fewer than two matching windows of 81 points; these heights are mixed "
      "with the walls and are left out of the statements above",
      fmt::join(texts, ", "));
}

std::vector<Fact> facts_of(const PaperHeights& heights) {
  const auto& cells = heights.rows;
  std::vector<Fact> facts;
  for (const std::size_t f : kWater) {
    const std::vector<HeightCell> seen = well_seen(heights.rows[f]);
    facts.push_back({"The raised bottom rises with the distance, " + kPaperFillings[f].label(), "yes",
                     verdict(std::is_sorted(seen.begin(), seen.end(), lower), heights_text(heights.rows[f]))});
  }
  bool deeper = true;
  for (std::size_t d = 0; d < kSeenDistances; ++d)
    deeper = deeper && cells[1][d].mean_mm < cells[2][d].mean_mm && cells[2][d].mean_mm < cells[3][d].mean_mm;
  facts.push_back({"It rises with the depth of the water at every distance", "yes",
                   verdict(deeper, fmt::format("{:.1f} → {:.1f} → {:.1f} mm at 400 mm", cells[1][2].mean_mm,
                                               cells[2][2].mean_mm, cells[3][2].mean_mm))});
  const double empty_highest = range_over_distance(cells[0]).second;
  facts.push_back({"10 mm of water against empty at 200 mm", "about 2 mm",
                   fmt::format("{:.1f} mm", cells[1][0].mean_mm - cells[0][0].mean_mm)});
  facts.push_back({"10 mm of water against empty, least over the distances", "at least about 1 mm",
                   fmt::format("{:.1f} mm", range_over_distance(cells[1]).first - empty_highest)});
  facts.push_back({"10 mm of milk tea against empty, least over the distances", "at least 7 mm",
                   fmt::format("{:.1f} mm", range_over_distance(cells[4]).first - empty_highest)});
  for (const std::size_t f : kMilkTea) {
    const auto [low, high] = range_over_distance(cells[f]);
    facts.push_back({"The milk tea's height does not depend on the distance, " + kPaperFillings[f].label(), "yes",
                     verdict(high - low < 1.0, fmt::format("{:.1f}–{:.1f} mm, surface at {:g} mm", low, high,
                                                           kPaperBottomMm + kPaperFillings[f].fill_mm))});
  }
  facts.push_back({"At 500 mm", "measured", few_points_text(heights)});
  std::vector<std::string> seen;
  for (std::size_t f = 0; f < cells.size(); ++f)
    if (cells[f].back().seen > 0)
      seen.push_back(fmt::format("{} ({:.0f} points)", kPaperFillings[f].label(), cells[f].back().points));
  facts.push_back({"At 600 mm the near wall hides the inside", "yes, left out of the chart",
                   seen.empty() ? "yes, for all fillings"
                                : fmt::format("hidden for {} of 7 fillings; seen in part: {}", 7 - seen.size(),
                                              fmt::join(seen, ", "))});
  return facts;
}

/// One row for a filling, a column pair for a distance, as gnuplot's histograms want it.
Table bars_of(const PaperHeights& heights) {
  std::vector<std::string> columns{"filling"};
  for (std::size_t d = 0; d < kSeenDistances; ++d) {
    columns.push_back(fmt::format("{:g} mm", kPaperDistancesMm[d]));
    columns.push_back(fmt::format("sd {:g} mm", kPaperDistancesMm[d]));
  }
  columns.emplace_back("true_mm");
  columns.emplace_back("few_500_mm");
  Table bars(columns);
  for (std::size_t f = 0; f < kPaperFillings.size(); ++f) {
    std::vector<std::string> cells{kPaperFillings[f].label()};
    for (std::size_t d = 0; d < kSeenDistances; ++d) {
      cells.push_back(mm(heights.rows[f][d].mean_mm));
      cells.push_back(mm(heights.rows[f][d].sd_mm));
    }
    cells.push_back(mm(kPaperBottomMm + kPaperFillings[f].fill_mm));
    const HeightCell& far = heights.rows[f][kSeenDistances - 1];
    cells.push_back(far.enough() ? "" : mm(far.mean_mm + 1.0));
    bars.add(cells);
  }
  return bars;
}

}  // namespace

Figure reproduce_fig5(const ReproduceSettings& settings, const PaperHeights& heights) {
  Figure figure{
      .name = "fig5",
      .title = "Fig. 5: measured height in the cup",
      .sentence =
          "Clear water raises the bottom the more the farther the cup stands and the deeper it is "
          "filled; milk tea shows its surface, whatever the distance.",
      .facts = facts_of(heights),
      .table = Table({"liquid", "fill_mm", "distance_mm", "height_mm", "height_sd_mm", "points", "shots_seen"})};
  for (std::size_t f = 0; f < kPaperFillings.size(); ++f)
    for (std::size_t d = 0; d < kPaperDistancesMm.size(); ++d) {
      const HeightCell& cell = heights.rows[f][d];
      figure.table.add({kPaperFillings[f].liquid, fmt::format("{:g}", kPaperFillings[f].fill_mm),
                        fmt::format("{:g}", kPaperDistancesMm[d]), cell.seen > 0 ? mm(cell.mean_mm) : "",
                        cell.seen > 1 ? mm(cell.sd_mm) : "", fmt::format("{:.1f}", cell.points),
                        fmt::format("{}", cell.seen)});
    }
  write_table(settings.folder / "fig5.csv", figure.table);
  write_table(settings.folder / "fig5_bars.csv", bars_of(heights));
  draw(settings.folder, figure.name,
       fmt::format(R"(
set title 'Measured height of the liquid''s surface or the raised bottom (simulated captures, {} each, ±1σ)'
set ylabel 'height above the desk [mm]'
set yrange [0:42]; set xrange [-0.6:6.6]; set ytics 5
set grid noxtics
set style data histogram
set style histogram errorbars gap 1.6 lw 1.5
set style fill solid 0.9 border lc rgb ink
set boxwidth 0.95
set errorbars 0.6
set xtics scale 0
set key top left reverse Left title 'distance of the cup' left
array colour[4] = [0xC6DFF0, sky, blue, 0x003E63]
plot for [i=1:4] 'fig5_bars.csv' using (column(2*i)):(column(2*i+1)):xtic(1) lc rgb colour[i] \
       title sprintf('%d mm', 100*i+100), \
     '' using ($0-0.42):'true_mm':(0.84):(0) with vectors nohead lw 2.5 dt 2 lc rgb red \
       title 'true surface (empty: bottom)', \
     '' using ($0+0.27):'few_500_mm' with points pt 2 ps 1 lw 2 lc rgb ink title 'few points left by the near wall')",
                   settings.trials));
  return figure;
}

}  // namespace fathom
