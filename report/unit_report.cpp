#include "report/unit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/files.h"
#include "core/table.h"
#include "report/gnuplot.h"
#include "report/html.h"

namespace fathom {
namespace {

constexpr int kEvery_px = 8;  ///< of the picture's points

/// Root mean square where desk was seen.
double rms(const Image<float>& image, const UnitCalibration& unit) {
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < image.size(); ++i)
    if (unit.seen.pixels()[i]) squares += image.pixels()[i] * image.pixels()[i], count += 1.0;
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

void draw_unit(const std::filesystem::path& folder, const UnitCalibration& unit) {
  Table table({"column_px", "row_px", "bias_px", "sigma_px"});
  double most = 0.05;
  for (int y = kEvery_px / 2; y < unit.bias_px.height(); y += kEvery_px)
    for (int x = kEvery_px / 2; x < unit.bias_px.width(); x += kEvery_px) {
      const bool seen = unit.seen(x, y);
      if (seen) most = std::max(most, static_cast<double>(std::abs(unit.bias_px(x, y))));
      table.add({fmt::format("{}", x), fmt::format("{}", y),
                 seen ? fmt::format("{:.4f}", unit.bias_px(x, y)) : std::string("nan"),
                 fmt::format("{:.4f}", unit.sigma_px(x, y))});
    }
  write_table(folder / "unit_map.csv", table);
  draw(folder, "unit_map",
       fmt::format(R"(
set title 'Bias of this device’s disparities'
unset key; unset grid; set size ratio -1; set border 15 lc rgb ink
set xrange [0:640]; set yrange [480:0]; set xlabel 'column [px]'; set ylabel 'row [px]'
set cblabel 'measured − true [px]'; set palette defined (0 '#0072B2', 0.5 '#FFFFFF', 1 '#D55E00')
set cbrange [-{0}:{0}]; set object 1 rectangle from 0,0 to 640,480 fillcolor rgb pale fillstyle solid noborder behind
plot 'unit_map.csv' using 'column_px':'row_px':'bias_px' with image pixels)",
                   std::ceil(most * 20.0) / 20.0));
}

std::string facts_html(const UnitCalibration& unit) {
  std::vector<std::vector<std::string>> rows;
  for (const Row& row : unit_rows(unit))
    rows.push_back({row.name,
                    std::holds_alternative<double>(row.value) ? fmt::format("{:.4g}", std::get<double>(row.value))
                                                              : std::get<std::string>(row.value),
                    row.unit});
  return html_table({"", "", ""}, rows);
}

}  // namespace

std::vector<Row> unit_rows(const UnitCalibration& unit) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  double seen = 0.0;
  for (const char desk : unit.seen.pixels()) seen += desk;
  std::vector<Row> rows{{"clouds", number(unit.clouds)},
                        {"views", number(unit.views)},
                        {"poses", number(unit.poses.size())},
                        {"focal_length", unit.scale.focal_px, "px"},
                        {"camera_offset", 1000.0 * unit.scale.camera_m, "mm"},
                        {"seen_share", seen / number(unit.seen.size())},
                        {"bias", rms(unit.bias_px, unit), "px"},
                        {"bias_sigma", rms(unit.sigma_px, unit), "px"},
                        {"desk_error_before", unit.without_px, "px"}};
  // A single view is predicted from itself, which says nothing of others.
  if (unit.views > 1) rows.push_back({"desk_error_after", unit.left_px, "px"});
  rows.push_back({"cell_error", unit.prior.cell_px, "px"});
  rows.push_back({"column_step", unit.prior.columns_px, "px"});
  rows.push_back({"noise", unit.noise.sigma_px, "px"});
  for (std::size_t i = 0; i < kNoiseLags_px.size(); ++i)
    rows.push_back({fmt::format("noise_correlation_x_{}", kNoiseLags_px[i]), unit.noise.along_rows[i]});
  for (std::size_t i = 0; i < kNoiseLags_px.size(); ++i)
    rows.push_back({fmt::format("noise_correlation_y_{}", kNoiseLags_px[i]), unit.noise.along_columns[i]});
  rows.push_back({"disparity_step", unit.depths.step_px, "px"});
  rows.push_back({"step_phase", unit.depths.phase});
  rows.push_back({"depth_cut", unit.depths.cut_mm, "mm"});
  rows.push_back({"depths_on_law", unit.depths.on_law});
  if (unit.warm_up) {
    rows.push_back({"warm_up", unit.warm_up->warm_up_px, "px"});
    rows.push_back({"warm_up_sigma", unit.warm_up->sigma_px, "px"});
    rows.push_back({"warm_up_time", unit.warm_up->warm_up_s, "s"});
  }
  return rows;
}

void write_unit_report(const std::filesystem::path& folder, const UnitCalibration& unit) {
  draw_unit(folder, unit);
  const double share = unit.without_px > 0.0 ? unit.left_px / unit.without_px : 1.0;
  std::string html = fmt::format(
      "<h1>One device, learned from {} cloud{}</h1>\n<p class=\"answer\">Its desks are off their planes by {:.3f} px "
      "of "
      "disparity. {} {:.3f} px: {:.0f} % of it.</p>\n",
      unit.clouds, unit.clouds == 1 ? "" : "s", unit.without_px,
      unit.views > 1 ? "When each view is predicted from the others, what is left is"
                     : "There is one view, so nothing can be said of others. Of its own error the map leaves",
      unit.left_px, 100.0 * share);
  html +=
      "<h2>The map</h2>\n<p>Measured minus true disparity at the clouds’ pixels, for desks as far away as those of "
      "these clouds. Grey: no desk was seen there. A plane over the whole of what was seen is pose, not bias, and "
      "is no part of it.</p>\n";
  html += html_picture(folder / "unit_map.png", "Bias of disparity over the image");
  html += "<h2>In numbers</h2>\n" + facts_html(unit);
  html +=
      "<p>bias, bias_sigma: root mean square where desk was seen. desk_error: of squares of 16 pixels, each view’s own "
      "plane apart, without and with what the other views say. cell_error: what the dots of a scene do to such a "
      "square. column_step: what a view’s own steps add from one column of squares to the next. noise: of single "
      "pixels.</p>\n";
  if (unit.poses.size() > 1) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < unit.poses.size(); ++i)
      rows.push_back({fmt::format("pose_{}_px", i), fmt::format("{}", unit.poses[i].clouds),
                      fmt::format("{:.0f}", unit.poses[i].height_mm), fmt::format("{:.1f}", unit.poses[i].pitch_deg),
                      fmt::format("{:.1f}", unit.poses[i].roll_deg)});
    html +=
        "<h2>Poses</h2>\n<p>In one pose the device does something of its own besides. Each has a channel in "
        "<code>unit_bias.exr</code>.</p>\n" +
        html_table({"channel", "clouds", "height [mm]", "pitch [°]", "roll [°]"}, rows, true);
  }
  write_text(folder / "report.html", html_page("Fathom: calibration", html));
}

}  // namespace fathom
