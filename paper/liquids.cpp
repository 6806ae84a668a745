// Fig. 5 of all the paper's liquids, of all light: what is measured in them, and how much of them.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/progress.h"
#include "core/rng.h"
#include "paper/figures.h"

namespace fathom {
namespace {

constexpr std::array<const char*, 5> kLiquids{"water", "barley_tea", "orange_juice", "tomato_juice", "milk_tea"};
constexpr std::array kFillsMm{10.0, 20.0, 30.0};

/// One liquid at one depth, over the distances at which the inside is seen.
struct LiquidRow {
  PaperFilling filling;
  std::array<HeightCell, kSeenDistances> cells;

  double surface_mm() const { return kPaperBottomMm + filling.fill_mm; }
  /// Those cells of which a statement may be made.
  std::vector<const HeightCell*> enough() const {
    std::vector<const HeightCell*> result;
    for (const HeightCell& cell : cells)
      if (cell.enough()) result.push_back(&cell);
    return result;
  }
  double matched() const {
    double sum = 0.0;
    for (const HeightCell& cell : cells) sum += cell.matched / kSeenDistances;
    return sum;
  }
};

/// "16.1–16.4 mm, surface at 17 mm; 83 % matched"
std::string heights_text(const LiquidRow& row) {
  const std::string matched =
      fmt::format("surface at {:g} mm; {:.0f} % matched", row.surface_mm(), 100.0 * row.matched());
  const std::vector<const HeightCell*> cells = row.enough();
  if (cells.empty()) return "too little is matched, " + matched;
  const auto [low, high] = std::minmax_element(
      cells.begin(), cells.end(), [](const HeightCell* a, const HeightCell* b) { return a->mean_mm < b->mean_mm; });
  return fmt::format("{:.1f}–{:.1f} mm, {}", (*low)->mean_mm, (*high)->mean_mm, matched);
}

/// Largest difference from water as deep and as far.
std::optional<double> off_water_mm(const std::vector<LiquidRow>& rows, const std::string& liquid) {
  std::optional<double> worst;
  for (const LiquidRow& row : rows)
    for (const LiquidRow& water : rows)
      for (std::size_t d = 0; d < kSeenDistances; ++d)
        if (row.filling.liquid == liquid && water.filling.liquid == "water" &&
            row.filling.fill_mm == water.filling.fill_mm && row.cells[d].enough() && water.cells[d].enough())
          worst = std::max(worst.value_or(0.0), std::abs(row.cells[d].mean_mm - water.cells[d].mean_mm));
  return worst;
}

std::vector<LiquidRow> measure_liquids(const ReproduceSettings& settings) {
  std::vector<LiquidRow> rows;
  Progress progress("condition", kLiquids.size() * kFillsMm.size() * kSeenDistances, settings.quiet);
  for (const char* liquid : kLiquids)
    for (const double fill_mm : kFillsMm) {
      LiquidRow& row = rows.emplace_back(LiquidRow{{liquid, fill_mm}, {}});
      for (std::size_t d = 0; d < kSeenDistances; ++d) {
        row.cells[d] = measure_height(
            row.filling, kPaperDistancesMm[d],
            {.light = LightModel::full, .trials = settings.shots(), .seed = Rng(settings.seed, rows.size(), d).bits()});
        progress.step();
      }
    }
  return rows;
}

/// One row for a filling: heights, then matched shares, of the distances; the surface, and what the paper prints.
Table bars_of(const std::vector<LiquidRow>& rows) {
  std::vector<std::string> columns{"filling"};
  for (const char* what : {"", "matched "})
    for (std::size_t d = 0; d < kSeenDistances; ++d)
      columns.push_back(fmt::format("{}{:g} mm", what, kPaperDistancesMm[d]));
  columns.insert(columns.end(), {"surface_mm", "printed_least_mm", "printed_most_mm"});
  Table bars(columns);
  for (const LiquidRow& row : rows) {
    std::vector<std::string> cells{row.filling.label()};
    for (const HeightCell& cell : row.cells) cells.push_back(cell.enough() ? mm_text(cell.mean_mm) : "");
    for (const HeightCell& cell : row.cells) cells.push_back(fmt::format("{:.3f}", cell.matched));
    cells.push_back(mm_text(row.surface_mm()));
    for (const double low_mm : {kPrintedMostLowMm, kPrintedLeastLowMm})
      cells.push_back(row.filling.liquid == "milk_tea" ? mm_text(row.surface_mm() - low_mm) : "");
    bars.add(cells);
  }
  return bars;
}

}  // namespace

Figure reproduce_liquids(const ReproduceSettings& settings) {
  const std::vector<LiquidRow> rows = measure_liquids(settings);
  Figure figure{.name = "liquids",
                .title = "Fig. 5 in full light, all liquids",
                .sentence =
                    "Barley tea shows its raised bottom as water does. The more a liquid scatters, the less is "
                    "matched in it; what is, lies below the surface and stays there over the distance.",
                .table = Table({"liquid", "fill_mm", "distance_mm", "height_mm", "height_sd_mm", "surface_mm", "points",
                                "matched_share"})};
  const std::optional<double> barley_mm = off_water_mm(rows, "barley_tea");
  figure.facts.push_back({"Barley tea against water, largest difference", "–",
                          barley_mm ? fmt::format("{:.1f} mm", *barley_mm) : "not seen"});
  for (const LiquidRow& row : rows) {
    figure.facts.push_back({"Height over the distances, " + row.filling.label(),
                            row.filling.liquid == "milk_tea" ? "constant, 1–2 mm below the surface" : "–",
                            heights_text(row)});
    for (std::size_t d = 0; d < kSeenDistances; ++d) {
      const HeightCell& cell = row.cells[d];
      figure.table.add({row.filling.liquid, fmt::format("{:g}", row.filling.fill_mm),
                        fmt::format("{:g}", kPaperDistancesMm[d]), cell.seen > 0 ? mm_text(cell.mean_mm) : "",
                        cell.seen > 1 ? mm_text(cell.sd_mm) : "", mm_text(row.surface_mm()),
                        fmt::format("{:.1f}", cell.points), fmt::format("{:.3f}", cell.matched)});
    }
  }
  write_table(settings.folder / "liquids_bars.csv", bars_of(rows));
  draw_figure(settings, figure, R"(
set title 'Measured height in all the liquids, of all light, and how much of them is matched'
set ylabel 'height above the desk [mm]'
set y2label 'share that is matched'
set yrange [0:42]; set xrange [-0.6:14.6]; set y2range [0:1.05]; set y2tics 0.2; set border 11
set grid noxtics
set style data histogram
set style histogram clustered gap 1.6
set style fill solid 0.9 border lc rgb ink
set boxwidth 0.95
set xtics scale 0 rotate by -40
set key below horizontal title 'distance of the cup'
array colour[4] = [0xC6DFF0, sky, blue, 0x003E63]
plot for [i=1:4] 'liquids_bars.csv' using (valid(i+1) ? column(i+1) : 0):xtic(1) lc rgb colour[i] title sprintf('%d mm', 100*i+100), \
     '' using ($0-0.42):'surface_mm':(0.84):(0) with vectors nohead lw 2.5 dt 2 lc rgb red title 'true surface', \
     '' using 0:'surface_mm':($0-0.44):($0+0.44):'printed_least_mm':'printed_most_mm' with boxxyerror fs transparent \
       solid 0.35 noborder lc rgb red title 'the paper: 1–2 mm low', \
     '' using 0:(0.5*(column('printed_least_mm')+column('printed_most_mm'))):(column('printed_least_mm')-1):(column('printed_most_mm')+1) \
       with yerrorbars ps 0 lw 2 lc rgb red title 'and its fill ±1 mm', \
     for [i=1:4] '' using ($0+(i-2.5)/5.6):(column(i+5)) axes x1y2 with points pt 7 ps 0.9 lc rgb orange \
       title (i == 1 ? 'share that is matched' : ''))");
  return figure;
}

}  // namespace fathom
