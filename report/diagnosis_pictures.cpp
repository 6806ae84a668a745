#include "report/diagnosis_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/table.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"
#include "report/fonts.h"
#include "report/gnuplot.h"
#include "report/gnuplot_text.h"
#include "report/heights_chart.h"

namespace fathom {
namespace {

/// A label in the middle of each liquid's stretch, and a line between two.
struct LiquidMarks {
  std::string commands, before_svg;  ///< as draw() takes them
};

LiquidMarks liquid_marks(const std::vector<Observation>& observations, const std::vector<std::size_t>& rows) {
  LiquidMarks marks;
  int number = 0;
  for (std::size_t first = 0; first < rows.size();) {
    const std::string& liquid = observations[rows[first]].factors.liquid;
    std::size_t end = first;
    while (end < rows.size() && observations[rows[end]].factors.liquid == liquid) ++end;
    ++number;
    const auto label = [&](const std::string& text) {
      return fmt::format("set label {} {} at {}, graph 0.96 center textcolor rgb ink noenhanced\n", number,
                         gnuplot_text(text), 0.5 * static_cast<double>(first + end - 1));
    };
    const std::string drawable = drawable_text(liquid);
    marks.commands += label(drawable);
    if (drawable != liquid) marks.before_svg += label(liquid);
    if (first > 0)
      marks.commands += fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead lc rgb pale\n",
                                    static_cast<double>(first) - 0.5);
    first = end;
  }
  return marks;
}

struct Mean {
  double before = 0.0, after = 0.0;
  int count = 0;

  void add(double was, double is) {
    before += was;
    after += is;
    ++count;
  }
};

/// One tile of the map: a third of the image, or a part of a disc.
struct Tile {
  double x, y, radius, from_deg, to_deg;
};
constexpr std::array<Tile, 5> kCupTiles{{{1.5, 1.5, 0.75, 0, 360},
                                         {1.5, 1.5, 1.5, 225, 315},
                                         {1.5, 1.5, 1.5, 45, 135},
                                         {1.5, 1.5, 1.5, 135, 225},
                                         {1.5, 1.5, 1.5, -45, 45}}};

std::map<std::string, Mean> means_by_region(const DiagnosedCampaign& campaign, std::string_view observable) {
  std::map<std::string, Mean> means;
  for (std::size_t i = 0; i < campaign.observations.size(); ++i)
    if (campaign.observations[i].observable == observable)
      means[campaign.observations[i].factors.region].add(campaign.diagnosis.residuals.before[i],
                                                         campaign.diagnosis.residuals.after[i]);
  return means;
}

}  // namespace

void write_residuals(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  Table table({"observable", "region", "session", "pour", "placement", "liquid", "fill_mm", "distance_mm", "lateral_mm",
               "measured", "before", "after", "sigma", "pixels"});
  for (std::size_t i = 0; i < campaign.observations.size(); ++i) {
    const Observation& o = campaign.observations[i];
    const Factors& f = o.factors;
    table.add({o.observable, f.region, fmt::format("{}", f.session), fmt::format("{}", f.pour),
               fmt::format("{}", f.placement), f.liquid, fmt::format("{:g}", f.fill_mm),
               fmt::format("{:g}", f.distance_mm), fmt::format("{:g}", f.lateral_mm), fmt::format("{:.5g}", o.value),
               fmt::format("{:.5g}", campaign.diagnosis.residuals.before[i]),
               fmt::format("{:.5g}", campaign.diagnosis.residuals.after[i]),
               fmt::format("{:.5g}", campaign.diagnosis.residuals.error[i]), fmt::format("{:.5g}", o.pixels)});
  }
  write_table(folder / "residuals.csv", table);
}

bool draw_heights(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  const std::vector<std::size_t> rows = heights_in_order(campaign.observations);
  if (rows.empty()) return false;
  Table table({"number", "before_mm", "after_mm", "sigma_mm"});
  for (std::size_t i = 0; i < rows.size(); ++i)
    table.add({fmt::format("{}", i), fmt::format("{:.4f}", campaign.diagnosis.residuals.before[rows[i]]),
               fmt::format("{:.4f}", campaign.diagnosis.residuals.after[rows[i]]),
               fmt::format("{:.4f}", campaign.diagnosis.residuals.error[rows[i]])});
  write_table(folder / "heights.csv", table);
  const LiquidMarks marks = liquid_marks(campaign.observations, rows);
  draw(folder, "heights",
       fmt::format(R"(
set title 'Heights in the cup: measured minus model'
set xlabel 'heights, by liquid, fill, distance and part of the cup'
set ylabel 'measured − model [mm]'
set xrange [-1:{}]; set offsets 0, 0, graph 0.12, graph 0.05; set key below; set format x ''
{}
plot 0 lc rgb ink notitle, \
     'heights.csv' using 'number':'before_mm' with points pt 7 ps 0.6 lc rgb orange title 'before', \
     '' using 'number':'after_mm':'sigma_mm' with yerrorbars pt 7 ps 0.6 lc rgb blue title 'after, with 1 σ')",
                   rows.size(), marks.commands),
       marks.before_svg);
  return true;
}

MapPicture draw_map(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  const auto desk = means_by_region(campaign, "desk_residual_mm"), cup = means_by_region(campaign, "height_mm");
  constexpr double kBefore = 4.6, kDesk = 4.2;  // where the upper row begins, and the right column
  // [mm] of the colours' range: what errors make of a single height is no strong colour.
  double most = std::max(campaign.diagnosis.gap.train.noise_floor_mm, 1e-3);
  Table tiles({"x", "y", "mean_mm"}), sectors({"x", "y", "radius", "from_deg", "to_deg", "mean_mm"}),
      unseen = sectors, numbers({"x", "y", "mean_mm"});
  std::string grey_centres;
  for (const bool after : {false, true}) {
    const double bottom = after ? 0.0 : kBefore;
    const auto value = [after, &most](const Mean& mean) {
      const double shown = (after ? mean.after : mean.before) / mean.count;
      most = std::max(most, std::abs(shown));
      return fmt::format("{:.4f}", shown);
    };
    for (std::size_t i = 0; i < kDeskRegionNames.size(); ++i)
      if (const auto found = desk.find(std::string(kDeskRegionNames[i])); found != desk.end())
        tiles.add({fmt::format("{}", kDesk + 0.5 + static_cast<double>(i % 3)),
                   fmt::format("{}", bottom + 2.5 - static_cast<double>(i / 3)), value(found->second)});
    // The centre last: it lies on the ring's sectors.
    for (const std::size_t i : {1U, 2U, 3U, 4U, 0U}) {
      const Tile& t = kCupTiles[i];
      const auto found = cup.find(std::string(kCupRegionNames[i]));
      const bool is_seen = found != cup.end();
      // Grey sectors are drawn first, so those of the ring would cover a grey centre: it is an object of its own.
      if (!is_seen && i == 0)
        grey_centres += fmt::format(
            "set object circle at {}, {} size {} front fillstyle solid border lc rgb ink "
            "fillcolor rgb '#D0D0D0'\n",
            t.x, bottom + t.y, t.radius);
      else
        (is_seen ? sectors : unseen)
            .add({fmt::format("{}", t.x), fmt::format("{}", bottom + t.y), fmt::format("{}", t.radius),
                  fmt::format("{}", t.from_deg), fmt::format("{}", t.to_deg), is_seen ? value(found->second) : "0"});
      const double middle = radians_from_deg(0.5 * (t.from_deg + t.to_deg)), out = i == 0 ? 0.0 : 0.75 * t.radius;
      if (is_seen)
        numbers.add({fmt::format("{:.3f}", t.x + out * std::cos(middle)),
                     fmt::format("{:.3f}", bottom + t.y + out * std::sin(middle)), value(found->second)});
    }
  }
  if (tiles.rows() == 0 || sectors.rows() == 0) return {};
  write_table(folder / "map_desk.csv", tiles);
  write_table(folder / "map_cup.csv", sectors);
  write_table(folder / "map_numbers.csv", numbers);
  if (unseen.rows() > 0) write_table(folder / "map_unseen.csv", unseen);
  const std::string sector = "using 'x':'y':'radius':'from_deg':'to_deg'";
  draw(folder, "map",
       fmt::format(R"(
set title 'Mean of measured minus model'
unset border; unset xtics; unset ytics; unset grid; unset key
set size ratio -1; set xrange [-1.6:8]; set yrange [-0.8:8.6]
set cblabel 'measured − model [mm]'; set palette defined (0 '#0072B2', 0.5 '#FFFFFF', 1 '#D55E00')
set cbrange [-{0}:{0}]
set label 'inside the cup, from above' at 1.5, 8.2 center; set label 'desk, by third of the image' at 5.7, 8.2 center
set label 'before' at -1.3, 6.1 center rotate by 90; set label 'after' at -1.3, 1.5 center rotate by 90
set label '↓ the sensor is on this side' at 1.5, 4.2 center; set label '↓ the sensor is on this side' at 1.5, -0.4 center
set label 'near the sensor' at 5.7, 4.2 center; set label 'near the sensor' at 5.7, -0.4 center
number(mm) = sprintf('%+.2f', mm)
{3}plot 'map_desk.csv' using 'x':'y':(0.5):(0.5):'mean_mm' with boxxyerror fillstyle solid border lc rgb ink fillcolor palette, \
     {1}'map_cup.csv' {2}:'mean_mm' with circles fillstyle solid border lc rgb ink fillcolor palette, \
     'map_desk.csv' using 'x':'y':(number(column('mean_mm'))) with labels font ',11' textcolor rgb ink, \
     'map_numbers.csv' using 'x':'y':(number(column('mean_mm'))) with labels font ',11' textcolor rgb ink)",
                   most,
                   unseen.rows() > 0
                       ? fmt::format("'map_unseen.csv' {} with circles fillstyle solid border lc rgb ink fillcolor rgb "
                                     "'#D0D0D0', ",
                                     sector)
                       : "",
                   sector, grey_centres));
  return {true, unseen.rows() > 0 || !grey_centres.empty()};
}

bool draw_shape(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  constexpr double kPanel = 6.0;  // a cell is one wide
  constexpr double kBefore = 6.4;
  double width_mm = std::numeric_limits<double>::infinity();
  for (const Observation& o : campaign.observations)
    if (const auto& at = o.factors.within_mm)
      for (const double along : {std::abs(at->x()), std::abs(at->y())})
        if (along > 0.5) width_mm = std::min(width_mm, along);
  Table cells({"x", "y", "mean_mm"});
  std::vector<std::string> liquids;
  double most = 1e-3;  // [mm] of the colours' range
  for (std::size_t i = 0; i < campaign.observations.size(); ++i) {
    const Factors& f = campaign.observations[i].factors;
    if (!f.within_mm) continue;
    const auto known = std::find(liquids.begin(), liquids.end(), f.liquid);
    const auto panel = static_cast<double>(known - liquids.begin());
    if (known == liquids.end()) liquids.push_back(f.liquid);
    for (const bool after : {false, true}) {
      const double shown = after ? campaign.diagnosis.residuals.after[i] : campaign.diagnosis.residuals.before[i];
      most = std::max(most, std::abs(shown));
      cells.add({fmt::format("{:.2f}", kPanel * panel + f.within_mm->x() / width_mm),
                 fmt::format("{:.2f}", (after ? 0.0 : kBefore) + f.within_mm->y() / width_mm),
                 fmt::format("{:.2f}", shown)});
    }
  }
  if (liquids.empty()) return false;
  write_table(folder / "shape.csv", cells);
  const auto label = [&](std::size_t panel, const std::string& text) {
    return fmt::format("set label {} {} at {}, {} center noenhanced\n", panel + 1, gnuplot_text(text),
                       kPanel * static_cast<double>(panel), kBefore + 3.2);
  };
  std::string labels, before_svg;
  for (std::size_t panel = 0; panel < liquids.size(); ++panel) {
    const std::string drawable = drawable_text(liquids[panel]);
    labels += label(panel, drawable);
    if (drawable != liquids[panel]) before_svg += label(panel, liquids[panel]);
    for (const double middle : {0.0, kBefore})
      labels += fmt::format("set object circle at {}, {} size 2.5 fillstyle empty border lc rgb pale\n",
                            kPanel * static_cast<double>(panel), middle);
  }
  draw(folder, "shape",
       fmt::format(R"(
set title 'Shape of what is seen in the cup, in mm: measured minus model'
unset border; unset xtics; unset ytics; unset grid; unset key
set size ratio -1; set xrange [-4:{1}]; set yrange [-4:{2}]
set cblabel 'measured − model [mm]'; set palette defined (0 '#7DB9DC', 0.5 '#FFFFFF', 1 '#F0A57A'); set cbrange [-{0}:{0}]
set label 100 'before' at -3.3, {5} center rotate by 90; set label 101 'after' at -3.3, 0 center rotate by 90
set label 102 '↓ the sensor is on this side' at {3}, -3.4 center
{4}
plot 'shape.csv' using 'x':'y':(0.5):(0.5):'mean_mm' with boxxyerror fillstyle solid border lc rgb pale fillcolor palette, \
     '' using 'x':'y':'mean_mm' with labels font ',10' textcolor rgb ink)",
                   most, kPanel * static_cast<double>(liquids.size()) - 3.0, kBefore + 4.2,
                   0.5 * kPanel * static_cast<double>(liquids.size() - 1), labels, kBefore),
       before_svg);
  return true;
}

bool draw_sessions(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  std::map<int, double> ends_s;  // of each session
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < campaign.observations.size(); ++i) {
    const Observation& o = campaign.observations[i];
    if (o.observable != "desk_height_mm") continue;
    rows.push_back(i);
    double& end_s = ends_s.try_emplace(o.factors.session, 0.0).first->second;
    end_s = std::max(end_s, o.factors.time_s);
  }
  double longest_s = 0.0;
  for (const auto& [session, end_s] : ends_s) longest_s = std::max(longest_s, end_s);
  if (rows.empty() || (ends_s.size() == 1 && longest_s == 0.0)) return false;
  // Sessions side by side, each as wide as the longest, and a tenth of that between them.
  const double unit = longest_s > 0.0 ? longest_s / 60.0 : 1.0, pitch = 1.1 * unit;
  std::string ticks;
  std::map<int, double> begins;
  const std::size_t each = (ends_s.size() + 9) / 10;  // at most ten have room for a name
  for (const auto& [session, end_s] : ends_s) {
    const double begin = pitch * static_cast<double>(begins.size());
    if (begins.size() % each == 0)
      ticks += fmt::format("{}'session {}' {:.3f}", ticks.empty() ? "" : ", ", session, begin + 0.5 * unit);
    begins.emplace(session, begin);
  }
  Table table({"x", "before_mm", "after_mm", "sigma_mm"});
  const Residuals& residuals = campaign.diagnosis.residuals;
  for (const std::size_t row : rows) {
    const Factors& f = campaign.observations[row].factors;
    table.add({fmt::format("{:.3f}", begins.at(f.session) + f.time_s / 60.0),
               fmt::format("{:.4f}", residuals.before[row]), fmt::format("{:.4f}", residuals.after[row]),
               fmt::format("{:.4f}", residuals.error[row])});
  }
  write_table(folder / "sessions.csv", table);
  draw(folder, "sessions",
       fmt::format(R"(
set title 'Height of the camera above the desk: measured minus model'
set xlabel '{}'
set ylabel 'measured − model [mm]'
set xrange [{:.3f}:{:.3f}]; set xtics ({}); set offsets 0, 0, graph 0.12, graph 0.05; set key below
plot 0 lc rgb ink notitle, \
     'sessions.csv' using 'x':'before_mm' with points pt 7 ps 0.6 lc rgb orange title 'before', \
     '' using 'x':'after_mm':'sigma_mm' with yerrorbars pt 7 ps 0.6 lc rgb blue title 'after, with 1 σ')",
                   longest_s > 0.0
                       ? fmt::format("sessions side by side; time runs to the right, {:.0f} min in the longest", unit)
                       : "sessions side by side",
                   -0.1 * unit, pitch * static_cast<double>(ends_s.size()), ticks));
  return true;
}

}  // namespace fathom
