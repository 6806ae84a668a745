#include "report/heights_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

#include "report/html.h"
#include "report/observable_words.h"

namespace fathom {
namespace {

constexpr double kWidth = 960.0, kHeight = 400.0, kLeft = 60.0, kTop = 28.0, kBottom = 370.0;  // px

/// Where a difference stands in the chart, which holds them all and 0.
class Scale {
 public:
  Scale(const Residuals& residuals, const std::vector<std::size_t>& rows) {
    for (const std::size_t row : rows) {
      const double before = residuals.before[row], after = residuals.after[row], error = residuals.error[row];
      low_ = std::min({low_, before, after - error});
      high_ = std::max({high_, before, after + error});
    }
    const double margin = 0.05 * std::max(high_ - low_, 1e-3);
    low_ -= margin, high_ += margin;
  }

  double y(double difference_mm) const { return kBottom - (difference_mm - low_) / (high_ - low_) * (kBottom - kTop); }

  /// Differences for lines across the chart: 1, 2 or 5 times a power of ten apart.
  std::vector<double> ticks() const {
    const double range = high_ - low_, power = std::pow(10.0, std::floor(std::log10(range)));
    const double step = range / power < 2.0 ? 0.2 * power : range / power < 5.0 ? 0.5 * power : power;
    std::vector<double> result;
    for (double number = std::ceil(low_ / step); number * step <= high_; ++number)
      result.push_back(number * step + 0.0);  // 0, not -0
    return result;
  }

 private:
  double low_ = 0.0, high_ = 0.0;
};

/// A path as a link: no character of it can be read as anything but a file's name.
std::string link_to(std::string_view path) {
  std::string link;
  for (const char c : path) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) || std::string_view("-._~/").find(c) != std::string_view::npos;
    link += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return link;
}

/// The shot of an observation, if there is one.
const ReportShot* shot_of(const DiagnosedCampaign& campaign, std::size_t row) {
  const int number = row < campaign.shots.of.size() ? campaign.shots.of[row] : -1;
  return number >= 0 ? &campaign.shots.shots[number] : nullptr;
}

std::string words_of(const DiagnosedCampaign& campaign, std::size_t row) {
  const Observation& o = campaign.observations[row];
  const Factors& f = o.factors;
  const ReportShot* shot = shot_of(campaign, row);
  return fmt::format(
      "{}, {} of the cup\nsession {}, pour {}, placement {}{}\nmeasured {:.2f} mm; measured − model: {:+.2f} mm "
      "before, "
      "{:+.2f} mm after, ± {:.2f} mm (1 σ)",
      condition_words(f), f.region, f.session, f.pour, f.placement, shot ? ", frame " + shot->frame : "", o.value,
      campaign.diagnosis.residuals.before[row], campaign.diagnosis.residuals.after[row],
      campaign.diagnosis.residuals.error[row]);
}

/// What a click on a point shows: nothing of it is seen before.
std::string shots_html(const ReportShots& shots) {
  std::string html;
  for (std::size_t i = 0; i < shots.shots.size(); ++i) {
    const ReportShot& shot = shots.shots[i];
    html += fmt::format(
        "<figure class=\"shot\" id=\"shot-{}\"><figcaption>Frame {}: {}; <a href=\"{}\">its "
        "cloud</a>{}</figcaption>\n",
        i, html_escaped(shot.frame), html_escaped(shot.condition), link_to(shot.cloud),
        shot.infrared.empty() ? "." : ", and the cup in infrared:");
    if (!shot.infrared.empty())
      html += html_picture(shot.infrared, fmt::format("Infrared image of frame {}", shot.frame));
    html += "</figure>\n";
  }
  return html;
}

/// A name over each liquid's stretch, and a line between two.
std::string liquids_svg(const std::vector<Observation>& observations, const std::vector<std::size_t>& rows,
                        double step) {
  std::string svg;
  for (std::size_t first = 0; first < rows.size();) {
    const std::string& liquid = observations[rows[first]].factors.liquid;
    std::size_t end = first;
    while (end < rows.size() && observations[rows[end]].factors.liquid == liquid) ++end;
    const double left = kLeft + step * static_cast<double>(first), right = kLeft + step * static_cast<double>(end);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (left + right),
                       kTop - 10.0, html_escaped(liquid));
    if (first > 0)
      svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ccc\"/>\n", left, kTop,
                         kBottom);
    first = end;
  }
  return svg;
}

}  // namespace

std::vector<std::size_t> heights_in_order(const std::vector<Observation>& observations) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (observations[i].observable == "height_mm") rows.push_back(i);
  const auto key = [&](std::size_t row) {
    const Factors& f = observations[row].factors;
    return std::tie(f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm, f.region, f.session, f.placement);
  };
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return rows;
}

std::string heights_chart(const DiagnosedCampaign& campaign) {
  const std::vector<std::size_t> rows = heights_in_order(campaign.observations);
  if (rows.empty()) return {};
  const Scale scale(campaign.diagnosis.residuals, rows);
  const double step = (kWidth - kLeft) / static_cast<double>(rows.size());
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Heights: measured minus model\" font-size=\"13\">\n",
      kWidth, kHeight);
  for (const double tick : scale.ticks())
    svg += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\"/><text x=\"{4}\" y=\"{5:.1f}\" "
        "text-anchor=\"end\">{6:.3g}</text>\n",
        kLeft, kWidth, scale.y(tick), tick == 0.0 ? "#222" : "#eee", kLeft - 6.0, scale.y(tick) + 4.0, tick);
  svg += liquids_svg(campaign.observations, rows, step);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = rows[i];
    const double x = kLeft + step * (static_cast<double>(i) + 0.5), after = campaign.diagnosis.residuals.after[row],
                 error = campaign.diagnosis.residuals.error[row];
    const bool has_shot = shot_of(campaign, row) != nullptr;
    if (has_shot) svg += fmt::format("<a href=\"#shot-{}\">", campaign.shots.of[row]);
    svg += fmt::format(
        "<g><title>{0}</title><line x1=\"{1:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{3:.1f}\" stroke=\"#0072B2\"/>"
        "<circle cx=\"{1:.1f}\" cy=\"{4:.1f}\" r=\"4\" fill=\"#D55E00\"/><circle cx=\"{1:.1f}\" cy=\"{5:.1f}\" r=\"4\" "
        "fill=\"#0072B2\"/></g>",
        html_escaped(words_of(campaign, row)), x, scale.y(after + error), scale.y(after - error),
        scale.y(campaign.diagnosis.residuals.before[row]), scale.y(after));
    svg += has_shot ? "</a>\n" : "\n";
  }
  const std::vector<ReportShot>& shots = campaign.shots.shots;
  const bool has_images =
      std::any_of(shots.begin(), shots.end(), [](const ReportShot& shot) { return !shot.infrared.empty(); });
  return svg +
         fmt::format(
             "<text x=\"{}\" y=\"{}\">measured − model [mm], by liquid, fill and place: "
             "<tspan fill=\"#D55E00\">● before</tspan> <tspan fill=\"#0072B2\">● after, with 1 σ</tspan></text>\n"
             "</svg>\n<p>Point at or tap a dot to read its condition{}.</p>\n",
             kLeft, kHeight - 8.0,
             shots.empty() ? ""
             : has_images  ? "; click it for its point cloud (.pcd) and its infrared image"
                           : "; click it for its point cloud (.pcd)") +
         shots_html(campaign.shots);
}

}  // namespace fathom
