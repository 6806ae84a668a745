// How strongly the paper's milk tea scatters: what is matched in it, and how far below its surface, over μs′.
#include <fmt/format.h>

#include <cmath>

#include "core/progress.h"
#include "core/units.h"
#include "paper/figures.h"
#include "report/gnuplot_text.h"
#include "sim/sensor/capture.h"

namespace fathom {
namespace {

constexpr std::array kReducedScatteringPerMm{0.5, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 4.0, 8.0};
constexpr double kFillMm = 20.0, kDistanceMm = 300.0;
/// Four times the usual: less of what is not matched is lost to the walks' own noise.
constexpr int kSamplesPerPixel = 4 * kDefaultSamplesPerPixel;
/// The paper's milk tea reads so much too low, and is matched.
constexpr double kLeastLowMm = 1.0, kMostLowMm = 2.0, kMatchedEnough = 0.5;
constexpr double kChance = 0.1;  ///< a smaller matched share is a few false matches and what the rim's windows see

struct Reading {
  double matched = 0.0;  ///< share of the surface's pixels that the projector lights
  double low_mm = 0.0;   ///< mean depth below the surface of what is matched
};

Reading read_milk_tea(double reduced_scattering_per_mm, std::uint64_t seed) {
  constexpr double kOutlierMm = 10.0;  // matched to something else
  constexpr int kDesk = 1;             // the first object
  Setup setup = paper_setup({"milk_tea", kFillMm}, kDistanceMm);
  Medium& tea = setup.scene.cups.front().filling->medium;
  tea.scattering = per_metre_from_per_mm(reduced_scattering_per_mm) / (1.0 - tea.anisotropy);
  Camera camera(setup, CaptureMode::photometric, kSamplesPerPixel, seed, LightModel::full);
  const Frame frame = camera.shoot(0);
  // Against the desk in the same cloud, as the paper measures: the device's law moves both alike.
  Reading reading;
  double lit = 0.0, matched = 0.0, desk = 0.0, desk_low_mm = 0.0;
  for (std::size_t i = 0; i < camera.truth().size(); ++i) {
    const TruePixel& truth = camera.truth().pixels()[i];
    const bool on_tea = truth.path == PathKind::scattered;
    if (!truth.apparent_depth) continue;
    lit += on_tea;
    if (!(frame.depth.pixels()[i] > 0.0f)) continue;
    const CloudPoint& point = frame.cloud.pixels()[i];
    const double height = (setup.rig.world_from_camera * Eigen::Vector3d(point.x, point.y, point.z)).z();
    const double low_mm = mm_from_metres(truth.position.z() - height);
    if (std::abs(low_mm) > kOutlierMm) continue;
    if (on_tea)
      ++matched, reading.low_mm += low_mm;
    else if (truth.object == kDesk)
      ++desk, desk_low_mm += low_mm;
  }
  if (matched > 0.0) reading.low_mm = reading.low_mm / matched - desk_low_mm / desk;
  if (lit > 0.0) reading.matched = matched / lit;
  return reading;
}

std::string interval_text(const std::vector<double>& values) {
  if (values.empty()) return "no value of the sweep";
  return fmt::format("{:g} to {:g} per mm, of the values in the sweep", values.front(), values.back());
}

}  // namespace

Figure reproduce_scattering(const ReproduceSettings& settings) {
  Figure figure{.name = "scattering",
                .title = "Milk tea: how strongly it scatters",
                .sentence =
                    "The less a liquid scatters the deeper its light comes from, and the more its dots blur, until "
                    "nothing can be matched.",
                .table = Table({"reduced_scattering_per_mm", "matched_share", "low_mm"})};
  std::vector<double> matched, low, both;
  Progress progress("milk tea", kReducedScatteringPerMm.size(), settings.quiet);
  for (const double per_mm : kReducedScatteringPerMm) {
    const Reading reading = read_milk_tea(per_mm, settings.seed);
    figure.table.add({fmt::format("{:g}", per_mm), fmt::format("{:.3f}", reading.matched),
                      reading.matched >= kChance ? mm_text(reading.low_mm) : ""});
    const bool is_matched = reading.matched >= kMatchedEnough;
    const bool is_low = reading.matched >= kChance && reading.low_mm >= kLeastLowMm && reading.low_mm <= kMostLowMm;
    if (is_matched) matched.push_back(per_mm);
    if (is_low) low.push_back(per_mm);
    if (is_matched && is_low) both.push_back(per_mm);
    progress.step();
  }
  figure.facts = {
      {"μs′ at which at least half of the milk tea's surface is matched", "matched", interval_text(matched)},
      {"μs′ at which it reads 1 to 2 mm low", "1–2 mm", interval_text(low)},
      {"μs′ at which both hold", "both", interval_text(both)}};
  draw_figure(
      settings, figure,
      fmt::format(
          R"(
set title {}
set xlabel 'reduced scattering coefficient μs'' [1/mm]'
set ylabel 'mean depth below the surface of what is matched [mm]' textcolor rgb blue
set y2label 'share of the surface that is matched' textcolor rgb orange
set logscale x; set xrange [0.4:10]; set xtics (0.5, 1, 2, 4, 8); set y2tics; set y2range [0:1]; set border 11
set yrange [-1:3]; set key at graph 0.98, 0.62 right
set object 1 rectangle from graph 0, first 1 to graph 1, first 2 fs solid noborder fc rgb '#EEEEEE' behind
set label 1 'the paper: 1–2 mm low' at graph 0.02, first 1.5 textcolor rgb ink
plot 'scattering.csv' using 'reduced_scattering_per_mm':'low_mm' with linespoints lw 3 pt 7 lc rgb blue title 'reads low by', \
     '' using 'reduced_scattering_per_mm':'matched_share' axes x1y2 with linespoints lw 3 pt 5 lc rgb orange \
       title 'matched share')",
          gnuplot_text(fmt::format("{:g} mm of milk tea, {:g} mm away: what the sensor matches, over its reduced "
                                   "scattering",
                                   kFillMm, kDistanceMm))));
  return figure;
}

}  // namespace fathom
