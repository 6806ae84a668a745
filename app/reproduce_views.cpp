// Fig. 2–4: the cloud from the side, in the world.
#include <fmt/format.h>

#include <cmath>

#include "app/cup_height.h"
#include "app/gnuplot.h"
#include "app/paper_scene.h"
#include "app/reproduce.h"
#include "core/units.h"
#include "sim/sensor/capture.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace {

constexpr double kDistanceMm = 400.0;
constexpr double kSliceHalfMetres = 0.012;  // a few columns of the image, so that the walls do not hide the inside
constexpr int kSamplesPerPixel = 4;

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
    const double along = p.y() - metres_from_mm(kDistanceMm);
    if (std::abs(p.x()) > kSliceHalfMetres || std::abs(along) > 0.09) continue;
    const bool inside = std::hypot(p.x(), along) < radius && p.z() < 0.06;
    table.add({fmt::format("{:.2f}", mm_from_metres(p.y())), fmt::format("{:.2f}", mm_from_metres(p.z())),
               inside ? "1" : "0"});
  }
  return table;
}

/// The cup's true walls and bottom, the liquid, and the points.
std::string plot_of(const View& view, double measured_mm) {
  const double surface = 7.0 + view.filling.fill_mm;
  const bool filled = view.filling.fill_mm > 0.0;
  std::string text = fmt::format(R"(
set title '{}'
set xlabel 'distance from the sensor y [mm]'
set ylabel 'height above the desk z [mm]'
set xrange [325:475]; set yrange [-8:100]; set xtics 25; set ytics 20
set size ratio -1
unset grid
set key off
wall = 0xF1ECE4
set object 1 rectangle from 357,0 to 443,7 fillcolor rgb wall fillstyle solid noborder back
set object 2 rectangle from 357,0 to 360,87 fillcolor rgb wall fillstyle solid noborder back
set object 3 rectangle from 440,0 to 443,87 fillcolor rgb wall fillstyle solid noborder back
set arrow 1 from 325,0 to 475,0 nohead lw 2 lc rgb ink front
set arrow 2 from 360,7 to 440,7 nohead lw 2.5 lc rgb green front
set label 1 'desk' at 473,3 right textcolor rgb ink
set label 2 'true bottom 7 mm' at 447,16 left textcolor rgb green
set arrow 3 from 446.5,15 to 438,7.6 lw 1.5 lc rgb green head filled size 2,18 front
)",
                                 view.title);
  if (filled)
    text +=
        fmt::format(R"(set object 4 rectangle from 360,7 to 440,{0} fillcolor rgb {1} fillstyle solid 1 noborder back
set arrow 4 from 360,{0} to 440,{0} nohead lw 2.5 dt 2 lc rgb blue front
set label 3 'true surface {0:g} mm' at 447,{2} left textcolor rgb blue
set arrow 5 from 446.5,{2} to 440.5,{0} lw 1.5 lc rgb blue head filled size 2,18 front
)",
                    surface, view.filling.liquid == "water" ? "0xE3F1FA" : "0xF3E6D3", surface + 8.0);
  if (filled && view.filling.liquid == "water")
    text += fmt::format(R"(set arrow 7 from 420,7.4 to 420,{0} heads filled size 1.6,18 lw 1.8 lc rgb ink front
set label 5 '+{1:.1f} mm' at 422,11.5 left textcolor rgb ink front
)",
                        measured_mm - 0.8, measured_mm - 7.0);
  text += fmt::format(R"(set label 4 '{0} {1:.1f} mm' at 363,{2} left textcolor rgb red front
set arrow 6 from 395,{3} to 405,{4} lw 1.5 lc rgb red head filled size 2,18 front
plot '{5}.csv' using 'y_mm':(column('inside') == 0 ? column('z_mm') : NaN) with points pt 7 ps 0.45 lc rgb 0x9A9A9A, \
     '' using 'y_mm':(column('inside') == 1 ? column('z_mm') : NaN) with points pt 7 ps 0.8 lc rgb red)",
                      view.what, measured_mm, measured_mm + 10.0, measured_mm + 7.5, measured_mm + 2.0, view.name);
  return text;
}

Figure reproduce_view(const View& view, const ReproduceSettings& settings) {
  const Setup setup = paper_setup(view.filling, kDistanceMm);
  const CupShape& cup = setup.scene.cups.front().shape;
  Camera camera(setup, CaptureMode::photometric, kSamplesPerPixel, settings.seed);
  const Image<CloudPoint> cloud = camera.shoot(0).cloud;
  const auto height = height_in_cup(cloud_from_image(cloud), paper_rig(setup), {0.0, metres_from_mm(kDistanceMm)});
  Figure figure{.name = view.name,
                .title = view.title,
                .sentence = view.sentence,
                .facts = {},
                .table = slice(cloud, setup.rig, cup)};
  write_table(settings.folder / (figure.name + ".csv"), figure.table);
  const double measured_mm = height ? mm_from_metres(height->mean_m) : 0.0;
  draw(settings.folder, figure.name, plot_of(view, measured_mm));
  figure.facts.push_back({"Mean height inside the cup above the desk", view.printed,
                          height ? fmt::format("{:.1f} mm, {} points with σ = {:.1f} mm", measured_mm, height->points,
                                               mm_from_metres(height->sd_m))
                                 : "nothing seen inside"});
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
  Figure figure = reproduce_view(
      {"fig4",
       "Fig. 4: cup with 30 mm of water, from the side",
       "Through clear water the bottom is measured, but raised: far above where it is, far below the surface.",
       "\"raised from the desk plane\"",
       "raised bottom",
       {"water", 30.0}},
      settings);
  const double raised = theory::raised_height_at(
      0.030,
      {.h = metres_from_mm(kPaperHeightMm - 7.0), .b = 0.075, .d = metres_from_mm(kDistanceMm), .n = kPaperIndex});
  figure.facts.push_back(
      {"The true bottom (7 mm) and what Eq. 7 adds", "–", fmt::format("{:.1f} mm", 7.0 + mm_from_metres(raised))});
  return figure;
}

}  // namespace fathom
