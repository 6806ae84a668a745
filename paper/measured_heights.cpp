// Fig. 5: what the paper's detector measures in simulated captures.
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "paper/figures.h"
#include "report/gnuplot_text.h"

namespace fathom {
namespace {

constexpr std::size_t kEmpty = 0;
constexpr std::array<std::size_t, 3> kWater{1, 2, 3}, kMilkTea{4, 5, 6};

constexpr const char* kNotSeen = "not seen";

/// The distances that a statement about these fillings may rest on.
std::vector<std::size_t> where_enough(std::initializer_list<const HeightRow*> rows) {
  std::vector<std::size_t> distances;
  for (std::size_t d = 0; d < kSeenDistances; ++d)
    if (std::all_of(rows.begin(), rows.end(), [d](const HeightRow* row) { return (*row)[d].enough(); }))
      distances.push_back(d);
  return distances;
}

std::string distances_text(const std::vector<std::size_t>& distances) {
  std::vector<std::string> texts;
  for (const std::size_t d : distances) texts.push_back(fmt::format("{:g}", kPaperDistancesMm[d]));
  return fmt::format("{} mm", fmt::join(texts, ", "));
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
      "for {} the near wall leaves fewer than two matching windows of {} points; these heights are mixed "
      "with the walls and are left out of the statements above",
      fmt::join(texts, ", "), kWindowPoints);
}

std::string rises_with_distance(const HeightRow& row) {
  const std::vector<std::size_t> distances = where_enough({&row});
  if (distances.size() < 2) return kNotSeen;
  bool rises = true;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    rises = rises && (i == 0 || row[distances[i - 1]].mean_mm < row[distances[i]].mean_mm);
    texts.push_back(fmt::format("{:.1f}", row[distances[i]].mean_mm));
  }
  return verdict(rises, fmt::format("{} mm at {}", fmt::join(texts, " → "), distances_text(distances)));
}

std::string rises_with_depth(const HeightRow& shallow, const HeightRow& middle, const HeightRow& deep) {
  const std::vector<std::size_t> distances = where_enough({&shallow, &middle, &deep});
  if (distances.empty()) return kNotSeen;
  const bool rises = std::all_of(distances.begin(), distances.end(), [&](std::size_t d) {
    return shallow[d].mean_mm < middle[d].mean_mm && middle[d].mean_mm < deep[d].mean_mm;
  });
  const std::size_t far = distances.back();
  return verdict(rises,
                 fmt::format("at {}; {:.1f} → {:.1f} → {:.1f} mm at {:g} mm", distances_text(distances),
                             shallow[far].mean_mm, middle[far].mean_mm, deep[far].mean_mm, kPaperDistancesMm[far]));
}

/// How much higher at the nearest distance.
std::string nearest_difference(const HeightRow& filled, const HeightRow& empty) {
  if (!filled.front().enough() || !empty.front().enough()) return kNotSeen;
  return fmt::format("{:.1f} mm", filled.front().mean_mm - empty.front().mean_mm);
}

/// How much higher at the distance where it is least, each distance by itself.
std::string least_difference(const HeightRow& filled, const HeightRow& empty) {
  const std::vector<std::size_t> distances = where_enough({&filled, &empty});
  if (distances.empty()) return kNotSeen;
  const auto difference = [&](std::size_t d) { return filled[d].mean_mm - empty[d].mean_mm; };
  const std::size_t least = *std::min_element(
      distances.begin(), distances.end(), [&](std::size_t a, std::size_t b) { return difference(a) < difference(b); });
  return fmt::format("{:.1f} mm, at {:g} mm", difference(least), kPaperDistancesMm[least]);
}

std::string does_not_depend_on_distance(const HeightRow& row, double surface_mm) {
  const std::vector<std::size_t> distances = where_enough({&row});
  if (distances.size() < 2) return kNotSeen;
  const auto [low, high] = std::minmax_element(distances.begin(), distances.end(), [&](std::size_t a, std::size_t b) {
    return row[a].mean_mm < row[b].mean_mm;
  });
  return verdict(row[*high].mean_mm - row[*low].mean_mm < 1.0,
                 fmt::format("{:.1f}–{:.1f} mm at {}, surface at {:g} mm", row[*low].mean_mm, row[*high].mean_mm,
                             distances_text(distances), surface_mm));
}

std::vector<Fact> facts_of(const PaperHeights& heights) {
  const auto& cells = heights.rows;
  std::vector<Fact> facts;
  for (const std::size_t f : kWater)
    facts.push_back({"The raised bottom rises with the distance, " + kPaperFillings[f].label(), "yes",
                     rises_with_distance(cells[f])});
  facts.push_back({"It rises with the depth of the water at every distance", "yes",
                   rises_with_depth(cells[kWater[0]], cells[kWater[1]], cells[kWater[2]])});
  facts.push_back(
      {"10 mm of water against empty at 200 mm", "about 2 mm", nearest_difference(cells[kWater[0]], cells[kEmpty])});
  facts.push_back({"10 mm of water against empty, least over the distances", "at least about 1 mm",
                   least_difference(cells[kWater[0]], cells[kEmpty])});
  facts.push_back({"10 mm of milk tea against empty, least over the distances", "at least 7 mm",
                   least_difference(cells[kMilkTea[0]], cells[kEmpty])});
  for (const std::size_t f : kMilkTea)
    facts.push_back({"The milk tea's height does not depend on the distance, " + kPaperFillings[f].label(), "yes",
                     does_not_depend_on_distance(cells[f], kPaperBottomMm + kPaperFillings[f].fill_mm)});
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
      cells.push_back(heights.rows[f][d].seen > 0 ? mm_text(heights.rows[f][d].mean_mm) : "");
      cells.push_back(mm_text(heights.rows[f][d].sd_mm));
    }
    cells.push_back(mm_text(kPaperBottomMm + kPaperFillings[f].fill_mm));
    const HeightCell& far = heights.rows[f][kSeenDistances - 1];
    cells.push_back(far.enough() || far.seen == 0 ? "" : mm_text(far.mean_mm + 1.0));
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
                        fmt::format("{:g}", kPaperDistancesMm[d]), cell.seen > 0 ? mm_text(cell.mean_mm) : "",
                        cell.seen > 1 ? mm_text(cell.sd_mm) : "", fmt::format("{:.1f}", cell.points),
                        fmt::format("{}", cell.seen)});
    }
  write_table(settings.folder / "fig5_bars.csv", bars_of(heights));
  const bool any_few = std::any_of(heights.rows.begin(), heights.rows.end(), [](const HeightRow& row) {
    return row[kSeenDistances - 1].seen > 0 && !row[kSeenDistances - 1].enough();
  });
  constexpr const char* kFewPoints = R"(, \
     '' using ($0+0.27):'few_500_mm' with points pt 2 ps 1 lw 2 lc rgb ink title 'few points left by the near wall')";
  draw_figure(
      settings, figure,
      fmt::format(R"(
set title {}
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
       title 'true surface (empty: bottom)'{})",
                  gnuplot_text(fmt::format("Measured height of the liquid's surface or the raised bottom (simulated "
                                           "captures, {} each, ±1σ)",
                                           settings.shots())),
                  any_few ? kFewPoints : ""));
  return figure;
}

}  // namespace fathom
