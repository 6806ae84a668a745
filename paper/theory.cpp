// Fig. 10, 12 and 13: what needs no capture.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/units.h"
#include "paper/figures.h"
#include "report/gnuplot_text.h"
#include "theory/raised_bottom.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

constexpr double kBaseline = 0.075;
constexpr double kHeight = (kPaperHeightMm - kPaperBottomMm) * kMetresPerMm;  // of the sensor above the cup's bottom
constexpr double kFieldOfViewDeg = 58.5, kMinimumRange = 0.5;                 // as the paper prints them

std::string number(double value) { return fmt::format("{:.4f}", value + 0.0); }

/// |θ1 − θ4| at `field` from the axis, positive away from the projector, for a sensor that looks straight down on a
/// bare plane whose point is `depth` along the axis away.
double skew(double field, double depth) {
  const theory::Triangulation dry = theory::triangulate({.sensor_height = depth,
                                                         .baseline = kBaseline,
                                                         .fill = 0.0,
                                                         .index = 1.0,
                                                         .lateral = -0.5 * kBaseline - depth * std::tan(field),
                                                         .distance = 0.0,
                                                         .pitch = 0.5 * std::numbers::pi});
  return std::abs(dry.incidence_projector - dry.incidence_camera);
}

}  // namespace

Figure reproduce_fig10(const ReproduceSettings& settings) {
  Figure figure{.name = "fig10",
                .title = "Fig. 10: height of the raised bottom over the incidence angle",
                .sentence = "The flatter the beam and the deeper the water, the higher the bottom seems to stand.",
                .table = Table({"fill_mm", "incidence_deg", "eq3_mm"})};
  Table exact({"fill_mm", "incidence_deg", "exact_mm"});
  for (const double fill : {10.0, 20.0, 30.0}) {
    const double w = metres_from_mm(fill);
    for (int degrees = 0; degrees <= 90; ++degrees)
      figure.table.add({number(fill), number(degrees),
                        number(mm_from_metres(theory::raised_height(w, radians_from_deg(degrees), kPaperIndex)))});
    for (const double distance : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.1, 1.6, 2.6}) {
      const theory::Triangulation point =
          theory::triangulate({.sensor_height = kHeight, .fill = w, .index = kPaperIndex, .distance = distance});
      exact.add({number(fill), number(deg_from_radians(point.incidence_camera)), number(mm_from_metres(point.height))});
    }
  }
  write_table(settings.folder / "fig10_exact.csv", exact);
  draw_figure(settings, figure, R"(
set title 'Raised bottom of a cup of water over the incidence angle (n = 1.333)'
set xlabel 'incidence angle of the beam [deg]'
set ylabel 'height of the raised bottom [mm]'
set xrange [0:90]; set yrange [0:31]; set xtics 10; set ytics 5
set key top left reverse Left
array colour[3] = [sky, blue, red]
plot for [i=1:3] 'fig10.csv' using 'incidence_deg':(column('fill_mm') == 10*i ? column('eq3_mm') : NaN) \
       with lines lw 3 lc rgb colour[i] title sprintf('water %d mm, Eq. 3', 10*i), \
     for [i=1:3] 'fig10_exact.csv' using 'incidence_deg':(column('fill_mm') == 10*i ? column('exact_mm') : NaN) \
       with points pt 6 ps 1.6 lw 2 lc rgb colour[i] title (i == 3 ? 'exact triangulation' : ''))");
  const auto at = [](double fill, double degrees) {
    return mm_from_metres(theory::raised_height(metres_from_mm(fill), radians_from_deg(degrees), kPaperIndex));
  };
  figure.facts = {{"Height at vertical incidence, 10 / 20 / 30 mm of water", "drawn: about 2.5 / 5 / 7.5 mm",
                   fmt::format("{:.2f} / {:.2f} / {:.2f} mm", at(10, 0), at(20, 0), at(30, 0))},
                  {"Height at grazing incidence", "drawn: the whole depth, 10 / 20 / 30 mm",
                   fmt::format("{:.2f} / {:.2f} / {:.2f} mm", at(10, 90), at(20, 90), at(30, 90))}};
  return figure;
}

Figure reproduce_fig12(const ReproduceSettings& settings) {
  Figure figure{.name = "fig12",
                .title = "Fig. 12: how much the incidence angles of the two beams differ",
                .sentence =
                    "The printed 6.95° is the difference at that edge of the camera's field of view which lies "
                    "away from the projector, 500 mm away; right below the camera it is larger.",
                .table = Table({"field_deg", "skew_at_500_mm_range_deg", "skew_at_500_mm_depth_deg"})};
  const int steps = 234;
  for (int i = 0; i <= steps; ++i) {
    const double field_deg = kFieldOfViewDeg * (static_cast<double>(i) / steps - 0.5);
    const double field = radians_from_deg(field_deg);
    figure.table.add({number(field_deg), number(deg_from_radians(skew(field, kMinimumRange * std::cos(field)))),
                      number(deg_from_radians(skew(field, kMinimumRange)))});
  }
  draw_figure(settings, figure, R"(
set title 'Difference of the incidence angles of projected and received beam, sensor looking straight down'
set xlabel 'angle of the camera''s ray from its axis [deg], positive away from the projector'
set ylabel '|θ_1 − θ_4| [deg]'
set xrange [-30:30]; set yrange [0:10]; set xtics 10; set ytics 2
set key bottom right reverse Left
set label 1 'field edge: 6.9522°' at 29.5,5.3 right textcolor rgb red
set arrow 1 from 28,5.6 to 29.1,6.7 lw 1.5 lc rgb red head filled size 0.5,18
set label 2 'below the camera: 8.53°' at 0,8.5308 offset 1,1 textcolor rgb blue
set label 3 '6.95° as printed' at 1.5,6.6 textcolor rgb ink
plot 6.95 with lines lw 1.5 dt 2 lc rgb ink notitle, \
     'fig12.csv' using 'field_deg':'skew_at_500_mm_range_deg' with lines lw 3 lc rgb blue \
       title '500 mm along the camera''s ray', \
     '' using 'field_deg':'skew_at_500_mm_depth_deg' with lines lw 2.5 dt 4 lc rgb orange \
       title '500 mm along the axis', \
     '+' using (29.25):(6.9522) every ::0::0 with points pt 7 ps 1.8 lc rgb red notitle)");
  const double edge = theory::skew_at_field_edge(kBaseline, radians_from_deg(kFieldOfViewDeg), kMinimumRange);
  figure.facts = {
      {"At the field's edge away from the projector, 500 mm along the ray", "6.95° \"at the maximum\"",
       fmt::format("{:.4f}°", deg_from_radians(edge))},
      {"Right below the camera, 500 mm away: the larger value", "not mentioned",
       fmt::format("{:.2f}°", deg_from_radians(skew(0.0, kMinimumRange)))},
      {"At the field's edge, 500 mm along the axis", "not mentioned",
       fmt::format("{:.2f}°", deg_from_radians(skew(0.5 * radians_from_deg(kFieldOfViewDeg), kMinimumRange)))}};
  return figure;
}

Figure reproduce_fig13(const ReproduceSettings& settings) {
  Figure figure{.name = "fig13",
                .title = "Fig. 13: incidence angle over the distance of the cup",
                .sentence =
                    "The farther the cup, the flatter the beams; Eq. 6 ignores that they bend in the water, "
                    "which makes them a little flatter still.",
                .table = Table({"distance_mm", "eq6_deg", "exact_30_mm_water_deg"})};
  const auto eq6 = [](double d) { return deg_from_radians(theory::incidence_angle_at(d, kBaseline, kHeight)); };
  const auto exact = [](double d) {
    return deg_from_radians(
        theory::triangulate({.sensor_height = kHeight, .fill = 0.030, .index = kPaperIndex, .distance = d})
            .incidence_camera);
  };
  for (int mm = 0; mm <= 1000; mm += 10)
    figure.table.add({number(mm), number(eq6(metres_from_mm(mm))), number(exact(metres_from_mm(mm)))});
  const std::string title =
      fmt::format("Incidence angle of the beams over the distance of the cup (sensor {:g} mm above the bottom)",
                  mm_from_metres(kHeight));
  draw_figure(settings, figure, "set title " + gnuplot_text(title) + R"(
set xlabel 'horizontal distance of the bottom point from the sensor [mm]'
set ylabel 'incidence angle [deg]'
set xrange [0:1000]; set yrange [0:60]; set xtics 100; set ytics 10
set key bottom right reverse Left
plot 'fig13.csv' using 'distance_mm':'eq6_deg' with lines lw 3 lc rgb blue title 'Eq. 6', \
     '' using 'distance_mm':'exact_30_mm_water_deg' with lines lw 2.5 dt 4 lc rgb red title 'exact, 30 mm of water')");
  figure.facts = {{"Incidence angle at 200 / 400 / 600 mm by Eq. 6", "drawn, for a height the text does not give",
                   fmt::format("{:.2f}° / {:.2f}° / {:.2f}°", eq6(0.2), eq6(0.4), eq6(0.6))},
                  {"The same, exact, through 30 mm of water", "taken as equal",
                   fmt::format("{:.2f}° / {:.2f}° / {:.2f}°", exact(0.2), exact(0.4), exact(0.6))}};
  return figure;
}

}  // namespace fathom
