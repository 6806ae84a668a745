// Fig. 14: the raised bottom by Eq. 7, exactly, and as measured in simulated captures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units.h"
#include "paper/figures.h"
#include "report/gnuplot_text.h"
#include "theory/raised_bottom.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

/// The closed and the exact height of the raised bottom above the bottom [mm].
struct Prediction {
  double eq7, exact_printed_index, exact_sensor_index;
};

Prediction predict(double fill_mm, double distance_mm) {
  static const double n_at_sensor = water_index_at_sensor();
  const double w = metres_from_mm(fill_mm), d = metres_from_mm(distance_mm);
  const double h = metres_from_mm(kPaperHeightMm - kPaperBottomMm);
  theory::TriangulationSetup setup{.sensor_height = h,
                                   .fill = w,
                                   .index = kPaperIndex,
                                   .distance = d,
                                   .pitch = std::atan2(metres_from_mm(kPaperHeightMm), 0.400)};
  const double printed = theory::triangulate(setup).height;
  setup.index = n_at_sensor;
  return {mm_from_metres(theory::raised_height_at(w, {.h = h, .b = setup.baseline, .d = d, .n = kPaperIndex})),
          mm_from_metres(printed), mm_from_metres(theory::triangulate(setup).height)};
}

/// One more part of the plot command, for the depths of water of which some distance is as asked: gnuplot warns of
/// empty series. `using_y` picks from a row what is drawn over the distance; the first depth carries the title.
template <class Asked>
std::string series(const std::array<HeightRow, kPaperFillings.size()>& rows, const Asked& asked,
                   const std::string& using_y, const char* style, const char* title) {
  std::vector<std::string> tens;
  for (std::size_t f = 0; f < kPaperFillings.size(); ++f)
    if (kPaperFillings[f].liquid == "water" && std::any_of(rows[f].begin(), rows[f].begin() + kSeenDistances, asked))
      tens.push_back(fmt::format("{:g}", kPaperFillings[f].fill_mm / 10.0));
  if (tens.empty()) return "";
  return fmt::format(
      ", \\\n     for [i in {}] 'fig14.csv' using 'distance_mm':(column('fill_mm') == 10*i && {} \\\n       with {} "
      "title (i eq {} ? {} : '')",
      gnuplot_text(fmt::format("{}", fmt::join(tens, " "))), using_y, style, gnuplot_text(tens.front()),
      gnuplot_text(title));
}

/// What was measured, in the three ways that fig14.csv holds.
std::string measured_series(const PaperHeights& heights) {
  const std::string enough = fmt::format("column('points') >= {} ? column('simulated_mm') : NaN)", kPointsEnough);
  const std::string few = fmt::format("column('points') < {} ? column('simulated_mm') : NaN)", kPointsEnough);
  return series(  // below the points, which bars would make hollow
             heights.rows, [](const HeightCell& cell) { return cell.enough() && cell.seen > 1; },
             enough + ":'simulated_sd_mm'", "yerrorbars pt 0 lw 2 lc rgb colour[int(i)]", "") +
         series(
             heights.rows, [](const HeightCell& cell) { return cell.enough(); }, enough,
             "points pt 7 ps 1.9 lc rgb colour[int(i)]", "simulated measurement, ±1σ") +
         series(
             heights.rows, [](const HeightCell& cell) { return cell.seen > 0 && !cell.enough(); }, few,
             "points pt 2 ps 1.3 lw 2 lc rgb colour[int(i)]", "the same, few points left by the near wall") +
         series(
             heights.noise_free, [](const HeightCell& cell) { return cell.seen > 0; },
             "1 ? column('geometric_mm') : NaN)", "points pt 4 ps 2.4 lw 1.8 lc rgb ink",
             "simulated without matching and noise");
}

std::string worst_text(const std::optional<double>& worst_mm) {
  return worst_mm ? fmt::format("{:.2f} mm", *worst_mm) : "not seen";
}

}  // namespace

Figure reproduce_fig14(const ReproduceSettings& settings, const PaperHeights& heights) {
  Figure figure{
      .name = "fig14",
      .title = "Fig. 14: theory and measurement of the raised bottom",
      .sentence =
          "Where enough of the bottom is seen, Eq. 7, the exact triangulation and the simulated measurement agree "
          "better than to the 1–2 mm of the paper's measurement.",
      .table = Table({"fill_mm", "distance_mm", "eq7_mm", "exact_n1333_mm", "exact_n830nm_mm", "simulated_mm",
                      "simulated_sd_mm", "simulated_minus_exact_mm", "points", "geometric_mm"})};
  Table curves({"fill_mm", "distance_mm", "eq7_mm", "exact_n1333_mm", "exact_n830nm_mm"});
  double closed_worst = 0.0, index_worst = 0.0, geometric_farthest_mm = 0.0;
  std::optional<double> measured_worst, geometric_worst;
  for (std::size_t f = 0; f < kPaperFillings.size(); ++f) {
    if (kPaperFillings[f].liquid != "water") continue;
    const double fill = kPaperFillings[f].fill_mm;
    for (int distance = 100; distance <= 700; distance += 10) {
      const Prediction p = predict(fill, distance);
      curves.add({mm_text(fill), mm_text(distance), mm_text(p.eq7), mm_text(p.exact_printed_index),
                  mm_text(p.exact_sensor_index)});
    }
    for (std::size_t d = 0; d < kSeenDistances; ++d) {
      const Prediction p = predict(fill, kPaperDistancesMm[d]);
      const HeightCell& cell = heights.rows[f][d];
      const double measured = cell.mean_mm - kPaperBottomMm;
      closed_worst = std::max(closed_worst, std::abs(p.eq7 - p.exact_printed_index));
      index_worst = std::max(index_worst, std::abs(p.exact_sensor_index - p.exact_printed_index));
      const HeightCell& noise_free = heights.noise_free[f][d];
      if (noise_free.seen > 0) {
        const double difference = std::abs(noise_free.mean_mm - kPaperBottomMm - p.exact_sensor_index);
        geometric_worst = std::max(geometric_worst.value_or(0.0), difference);
        geometric_farthest_mm = std::max(geometric_farthest_mm, kPaperDistancesMm[d]);
      }
      if (cell.enough())
        measured_worst = std::max(measured_worst.value_or(0.0), std::abs(measured - p.exact_sensor_index));
      figure.table.add({mm_text(fill), mm_text(kPaperDistancesMm[d]), mm_text(p.eq7), mm_text(p.exact_printed_index),
                        mm_text(p.exact_sensor_index), cell.seen > 0 ? mm_text(measured) : "",
                        cell.seen > 1 ? mm_text(cell.sd_mm) : "",
                        cell.seen > 0 ? mm_text(measured - p.exact_sensor_index) : "",
                        fmt::format("{:.1f}", cell.points),
                        noise_free.seen > 0 ? mm_text(noise_free.mean_mm - kPaperBottomMm) : ""});
    }
  }
  write_table(settings.folder / "fig14_curves.csv", curves);
  draw_figure(settings, figure,
              R"(
set title 'Height of the raised bottom over the distance of the cup'
set xlabel 'horizontal distance of the cup from the sensor [mm]'
set ylabel 'height of the raised bottom above the bottom [mm]'
set xrange [100:700]; set yrange [0:14]; set xtics 100; set ytics 2
set key top left reverse Left
set errorbars 1
array colour[3] = [sky, blue, red]
do for [i=1:3] { set label i sprintf('water %d mm', 10*i) at 690,(i==1?4.35:i==2?8.2:12.05) right textcolor rgb colour[i] }
plot for [i=1:3] 'fig14_curves.csv' using 'distance_mm':(column('fill_mm') == 10*i ? column('eq7_mm') : NaN) \
       with lines lw 3 lc rgb colour[i] title (i == 2 ? 'Eq. 7, n = 1.333' : ''), \
     for [i=1:3] '' using 'distance_mm':(column('fill_mm') == 10*i ? column('exact_n830nm_mm') : NaN) \
       with lines lw 2 dt 3 lc rgb ink title (i == 2 ? 'exact, n of water at 830 nm' : ''))" +
                  measured_series(heights));
  figure.facts = {
      {"Largest difference of measurement and theory", "approximately 1–2 mm",
       fmt::format("{} (photometric capture against exact with n = {:.4f} at 830 nm, where enough is seen)",
                   worst_text(measured_worst), water_index_at_sensor())},
      {fmt::format("The same without matching and noise, to {:g} mm", geometric_farthest_mm), "–",
       worst_text(geometric_worst)},
      {"Largest difference of Eq. 7 and exact triangulation, both with n = 1.333", "–",
       fmt::format("{:.2f} mm", closed_worst)},
      {"Largest effect of taking n at 830 nm instead of 1.333", "–", fmt::format("{:.2f} mm", index_worst)}};
  return figure;
}

}  // namespace fathom
