// The remade figures as files: each with its table, and all in report.html, which needs no other file.
#include <fmt/format.h>

#include "core/files.h"
#include "paper/figures.h"
#include "report/gnuplot.h"
#include "report/html.h"

namespace fathom {
namespace {

std::string facts_html(const std::vector<Fact>& facts) {
  std::vector<std::vector<std::string>> rows;
  for (const Fact& fact : facts) rows.push_back({fact.what, fact.printed, fact.here});
  return html_table({"", "paper", "Fathom"}, rows);
}

}  // namespace

std::string mm_text(double mm) { return fmt::format("{:.3f}", mm + 0.0); }

void draw_figure(const ReproduceSettings& settings, const Figure& figure, const std::string& plot) {
  write_table(settings.folder / (figure.name + ".csv"), figure.table);
  draw(settings.folder, figure.name, plot);
}

void write_report(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
  std::string html =
      "<h1>Cups, liquids and a depth camera: the paper’s figures, remade</h1>\n<p>Hara, Honda, Tsubouchi &amp; Ohya "
      "measured cups with an ASUS Xtion PRO LIVE (IROS 2014). Here a simulated Xtion looks at simulated cups, "
      "and the paper’s detector measures them. The sensor stands 650 mm above the desk and "
      "aims at (0, 400, 0) mm; the cup’s bottom lies 7 mm above the desk, its inner radius is 40 mm. The paper’s text "
      "gives none of these four numbers: they are assumptions. Liquids that scatter are simulated as opaque at their "
      "surface.</p>\n";
  for (const Figure& figure : figures)
    html += fmt::format("<h2>{}</h2>\n<p>{}</p>\n{}{}{}", html_escaped(figure.title), html_escaped(figure.sentence),
                        html_picture(folder / (figure.name + ".png"), figure.title), facts_html(figure.facts),
                        html_details(figure.table, figure.name + ".csv"));
  write_text(folder / "report.html", html_page(kReportTitle, html));
}

}  // namespace fathom
