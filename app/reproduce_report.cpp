// report.html: the remade figures in one file that needs no other.
#include <fmt/format.h>

#include "app/reproduce.h"
#include "core/files.h"

namespace fathom {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Fathom: the figures of the paper, remade</title>
<style>
body { font: 17px/1.55 system-ui, "DejaVu Sans", sans-serif; color: #222; max-width: 60rem; margin: 2.5rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.8rem; line-height: 1.2; } h2 { font-size: 1.25rem; margin-top: 3.2rem; border-top: 1px solid #ddd; padding-top: 1.4rem; }
img { width: 100%; height: auto; margin: .4rem 0 .8rem; }
table { border-collapse: collapse; font-size: .88rem; margin: .6rem 0; } th { text-align: left; border-bottom: 2px solid #888; }
th, td { padding: .28rem .9rem .28rem 0; vertical-align: top; } td { border-bottom: 1px solid #e4e4e4; }
.data td, .data th { text-align: right; font-variant-numeric: tabular-nums; } summary { cursor: pointer; color: #0072B2; }
</style></head><body>
)";

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : kDigits[group >> (18 - 6 * j) & 63U];
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
  return result;
}

std::string facts_html(const std::vector<Fact>& facts) {
  std::string html = "<table><tr><th></th><th>paper</th><th>Fathom</th></tr>\n";
  for (const Fact& fact : facts)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(fact.what), escaped(fact.printed),
                        escaped(fact.here));
  return html + "</table>\n";
}

std::string table_html(const Table& table, const std::string& file) {
  if (table.rows() == 0) return fmt::format("<p>Data: <code>{}</code></p>\n", file);
  std::string html =
      fmt::format("<details><summary>{} ({} rows)</summary><table class=\"data\"><tr>", file, table.rows());
  for (const std::string& column : table.columns()) html += fmt::format("<th>{}</th>", escaped(column));
  html += "</tr>\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    html += "<tr>";
    for (const std::string& column : table.columns())
      html += fmt::format("<td>{}</td>", escaped(table.text(row, column)));
    html += "</tr>\n";
  }
  return html + "</table></details>\n";
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
  std::string html = kHead;
  html +=
      "<h1>Cups, liquids and a depth camera: the paper’s figures, remade</h1>\n<p>Hara, Honda, Tsubouchi &amp; Ohya "
      "measured cups with an ASUS Xtion PRO LIVE (IROS 2014). Here a simulated Xtion looks at simulated cups, "
      "and the paper’s detector measures them. The sensor stands 650 mm above the desk and "
      "aims at (0, 400, 0) mm; the cup’s bottom lies 7 mm above the desk, its inner radius is 40 mm. The paper’s text "
      "gives none of these four numbers: they are assumptions. Liquids that scatter are simulated as opaque at their "
      "surface.</p>\n";
  for (const Figure& figure : figures)
    html += fmt::format("<h2>{}</h2>\n<p>{}</p>\n<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n{}{}",
                        escaped(figure.title), escaped(figure.sentence), escaped(figure.title),
                        base64(read_text(folder / (figure.name + ".png"))), facts_html(figure.facts),
                        table_html(figure.table, figure.name + ".csv"));
  write_text(folder / "report.html", html + "</body></html>\n");
}

}  // namespace fathom
