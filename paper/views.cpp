// Fig. 2–4: the cloud from the side, in the world.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "campaign/cup_height.h"
#include "core/units.h"
#include "paper/figures.h"
#include "report/gnuplot_text.h"
#include "sim/sensor/capture.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace {

constexpr double kViewedMm = 400.0;
constexpr double kSliceHalfMetres = 0.012;  // a few columns of the image, so that the walls do not hide the inside
constexpr double kShownHalfMm = 75.0;       // of the picture's width

struct View {
  const char *name, *title, *sentence, *printed, *what;
  PaperFilling filling;
};

/// Points near the cup's middle plane: y and z in the world, and whether they count as inside.
Table slice(const Image<CloudPoint>& cloud, const Rig& rig, const CupShape& cup) {
  Table table({"y_mm", "z_mm", "inside"});
  const double radius = cup.inner_radius(cup.bottom()) - InteriorSettings{}.margin_m;
  for (const CloudPoint& point : cloud.pixels()) {
    if (!(point.z > 0.0f)) continue;  // NaN: not measured
    const Eigen::Vector3d p = rig.world_from_camera * Eigen::Vector3d(point.x, point.y, point.z);
    const double along = p.y() - metres_from_mm(kViewedMm);
    if (std::abs(p.x()) > kSliceHalfMetres || std::abs(along) > 0.09) continue;
    const bool inside = std::hypot(p.x(), along) < radius && p.z() < 0.06;
    table.add({fmt::format("{:.2f}", mm_from_metres(p.y())), fmt::format("{:.2f}", mm_from_metres(p.z())),
               inside ? "1" : "0"});
  }
  return table;
}

/// The cup's true walls and bottom, and the desk.
std::string cup_plot(const CupShape& cup) {
  const double inner = mm_from_metres(cup.inner_radius(cup.bottom())), outer = mm_from_metres(cup.outer.back().x());
  return fmt::format(R"(
set xrange [{near}:{far}]; set yrange [-8:100]; set xtics 25; set ytics 20
set object 1 rectangle from {outer_near},0 to {outer_far},{bottom} fillcolor rgb wall fillstyle solid noborder back
set object 2 rectangle from {outer_near},0 to {inner_near},{rim} fillcolor rgb wall fillstyle solid noborder back
set object 3 rectangle from {inner_far},0 to {outer_far},{rim} fillcolor rgb wall fillstyle solid noborder back
set arrow 1 from {near},0 to {far},0 nohead lw 2 lc rgb ink front
set arrow 2 from {inner_near},{bottom} to {inner_far},{bottom} nohead lw 2.5 lc rgb green front
set label 1 'desk' at {far}-2,3 right textcolor rgb ink
set label 2 {words} at {outer_far}+4,{bottom}+9 left textcolor rgb green
set arrow 3 from {outer_far}+3.5,{bottom}+8 to {inner_far}-2,{bottom}+0.6 lw 1.5 lc rgb green head filled size 2,18 front
)",
                     fmt::arg("near", kViewedMm - kShownHalfMm), fmt::arg("far", kViewedMm + kShownHalfMm),
                     fmt::arg("inner_near", kViewedMm - inner), fmt::arg("inner_far", kViewedMm + inner),
                     fmt::arg("outer_near", kViewedMm - outer), fmt::arg("outer_far", kViewedMm + outer),
                     fmt::arg("words", gnuplot_text(fmt::format("true bottom {:g} mm", mm_from_metres(cup.bottom())))),
                     fmt::arg("bottom", mm_from_metres(cup.bottom())), fmt::arg("rim", mm_from_metres(cup.height())));
}

std::string liquid_plot(const PaperFilling& filling, const CupShape& cup) {
  const double inner = mm_from_metres(cup.inner_radius(cup.bottom())), outer = mm_from_metres(cup.outer.back().x());
  const double bottom = mm_from_metres(cup.bottom());
  return fmt::format(
      R"(set object 4 rectangle from {near},{bottom} to {far},{surface} fillcolor rgb {colour} fillstyle solid 1 noborder back
set arrow 4 from {near},{surface} to {far},{surface} nohead lw 2.5 dt 2 lc rgb blue front
set label 3 {words} at {outer}+4,{surface}+8 left textcolor rgb blue
set arrow 5 from {outer}+3.5,{surface}+8 to {far}+0.5,{surface} lw 1.5 lc rgb blue head filled size 2,18 front
)",
      fmt::arg("near", kViewedMm - inner), fmt::arg("far", kViewedMm + inner), fmt::arg("outer", kViewedMm + outer),
      fmt::arg("bottom", bottom), fmt::arg("surface", bottom + filling.fill_mm),
      fmt::arg("words", gnuplot_text(fmt::format("true surface {:g} mm", bottom + filling.fill_mm))),
      fmt::arg("colour", filling.liquid == "water" ? "0xE3F1FA" : "0xF3E6D3"));
}

/// The mean height inside; of water also how far it lies above the true bottom.
std::string measured_plot(const View& view, double measured_mm, double bottom_mm) {
  std::string text =
      fmt::format(R"(set label 4 {0} at {2}-37,{1}+10 left textcolor rgb red front
set arrow 6 from {2}-5,{1}+7.5 to {2}+5,{1}+2 lw 1.5 lc rgb red head filled size 2,18 front
)",
                  gnuplot_text(fmt::format("{} {:.1f} mm", view.what, measured_mm)), measured_mm, kViewedMm);
  if (view.filling.liquid == "water")
    text += fmt::format(
        R"(set arrow 7 from {0}+20,{1}+0.4 to {0}+20,{2}-0.8 heads filled size 1.6,18 lw 1.8 lc rgb ink front
set label 5 {3} at {0}+22,{1}+4.5 left textcolor rgb ink front
)",
        kViewedMm, bottom_mm, measured_mm, gnuplot_text(fmt::format("+{:.1f} mm", measured_mm - bottom_mm)));
  return text;
}

/// The cup, the liquid, and the points of NAME.csv.
std::string plot_of(const View& view, const CupShape& cup, const Table& points, std::optional<double> measured_mm) {
  std::string text = fmt::format(R"(
set title {}
set xlabel 'distance from the sensor y [mm]'
set ylabel 'height above the desk z [mm]'
set size ratio -1
unset grid
set key off
wall = 0xF1ECE4)",
                                 gnuplot_text(view.title));
  text += cup_plot(cup);
  if (view.filling.fill_mm > 0.0) text += liquid_plot(view.filling, cup);
  if (measured_mm) text += measured_plot(view, *measured_mm, mm_from_metres(cup.bottom()));
  text += fmt::format(
      "plot {} using 'y_mm':(column('inside') == 0 ? column('z_mm') : NaN) with points pt 7 ps 0.45 "
      "lc rgb 0x9A9A9A",
      gnuplot_text(view.name + std::string(".csv")));
  bool any_inside = false;
  for (std::size_t row = 0; row < points.rows(); ++row) any_inside = any_inside || points.text(row, "inside") == "1";
  if (any_inside)
    text += ", '' using 'y_mm':(column('inside') == 1 ? column('z_mm') : NaN) with points pt 7 ps 0.8 lc rgb red";
  return text;
}

Figure reproduce_view(const View& view, const ReproduceSettings& settings) {
  const Setup setup = paper_setup(view.filling, kViewedMm);
  const CupShape& cup = std::get<CupShape>(setup.scene.cups.front().shape);
  Camera camera(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, settings.seed, LightModel::direct);
  const Image<CloudPoint> cloud = camera.shoot(0).cloud;
  const auto found = height_in_cup(cloud_from_image(cloud), paper_rig(setup), {0.0, metres_from_mm(kViewedMm)});
  const InteriorHeight* height = std::get_if<InteriorHeight>(&found);
  Figure figure{
      .name = view.name, .title = view.title, .sentence = view.sentence, .table = slice(cloud, setup.rig, cup)};
  std::optional<double> measured_mm;
  if (height) measured_mm = mm_from_metres(height->mean_m);
  draw_figure(settings, figure, plot_of(view, cup, figure.table, measured_mm));
  figure.facts.push_back({"Mean height inside the cup above the desk", view.printed,
                          height ? fmt::format("{:.1f} mm, {} points with σ = {:.1f} mm", *measured_mm, height->points,
                                               mm_from_metres(height->sd_m))
                                 : std::string(name_of(std::get<NoHeight>(found)))});
  figure.table = Table({});  // thousands of points say nothing in a report
  return figure;
}

}  // namespace

Figure reproduce_fig2(const ReproduceSettings& settings) {
  return reproduce_view({"fig2",
                         "Fig. 2: empty cup, from the side",
                         "The bottom of the empty cup is measured where it is, next to the desk.",
                         "\"cup bottom was in contact\" with the desk",
                         "measured bottom",
                         {"empty", 0.0}},
                        settings);
}

Figure reproduce_fig3(const ReproduceSettings& settings) {
  return reproduce_view({"fig3",
                         "Fig. 3: cup with 30 mm of milk tea, from the side",
                         "Of an opaque liquid the surface itself is measured.",
                         "the liquid surface, 1–2 mm too low",
                         "measured surface",
                         {"milk_tea", 30.0}},
                        settings);
}

Figure reproduce_fig4(const ReproduceSettings& settings) {
  const PaperFilling filling{"water", 30.0};
  Figure figure = reproduce_view(
      {"fig4", "Fig. 4: cup with 30 mm of water, from the side",
       "Through clear water the bottom is measured, but raised: far above where it is, far below the surface.",
       "\"raised from the desk plane\"", "raised bottom", filling},
      settings);
  const double raised_m = theory::raised_height_at(metres_from_mm(filling.fill_mm),
                                                   {.h = metres_from_mm(kPaperHeightMm - kPaperBottomMm),
                                                    .b = paper_setup(filling, kViewedMm).rig.sensor.baseline,
                                                    .d = metres_from_mm(kViewedMm),
                                                    .n = kPaperIndex});
  figure.facts.push_back({fmt::format("The true bottom ({:g} mm) and what Eq. 7 adds", kPaperBottomMm), "–",
                          fmt::format("{:.1f} mm", kPaperBottomMm + mm_from_metres(raised_m))});
  return figure;
}

}  // namespace fathom
