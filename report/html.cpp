#include "report/html.h"

#include <fmt/format.h>

#include "core/base64.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/visible_text.h"

namespace fathom {
namespace {

constexpr const char* kPageHead = R"(<style>
body { font: 17px/1.55 system-ui, "DejaVu Sans", sans-serif; color: #222; max-width: 60rem; margin: 2.5rem auto; padding: 0 1.2rem; }
body { overflow-wrap: anywhere; } .wide { overflow-x: auto; } .wide * { overflow-wrap: normal; }
h1 { font-size: 1.8rem; line-height: 1.2; } h2 { font-size: 1.25rem; margin-top: 3.2rem; border-top: 1px solid #ddd; padding-top: 1.4rem; }
img { width: 100%; height: auto; margin: .4rem 0 .8rem; } .answer { font-size: 1.25rem; line-height: 1.45; }
table { border-collapse: collapse; font-size: .88rem; margin: .6rem 0; } th { text-align: left; border-bottom: 2px solid #888; }
th, td { padding: .28rem .9rem .28rem 0; vertical-align: top; } td { border-bottom: 1px solid #e4e4e4; }
.shot:not(:target) { display: none; } .shot { margin: 0; } .shot img { width: 60%; image-rendering: pixelated; }
.data td:not(:first-child), .data th:not(:first-child) { text-align: right; font-variant-numeric: tabular-nums; } summary { cursor: pointer; color: #0072B2; }
</style>)";

std::string picture_of(std::string_view png, std::string_view alternative) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", html_escaped(alternative), base64(png));
}

/// With a minus sign, where the text is a number.
std::string with_minus(const std::string& cell) {
  const bool is_negative = cell.size() > 1 && cell[0] == '-' && cell[1] >= '0' && cell[1] <= '9';
  return is_negative ? fmt::format("−{}", cell.substr(1)) : cell;
}

std::string row_html(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, html_escaped(with_minus(cell)));
  return html + "</tr>\n";
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : visible_text(text)) switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string html_page(std::string_view title, std::string_view body, std::string_view head) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n{}{}</head><body>\n{}</body></html>\n",
      html_escaped(title), kPageHead, head, body);
}

std::string html_picture(const std::filesystem::path& png, std::string_view alternative) {
  return picture_of(read_text(png), alternative);
}

std::string html_picture(const Image<std::uint8_t>& grey, std::string_view alternative) {
  return picture_of(png_bytes(grey), alternative);
}

std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       bool numbers) {
  std::string html = numbers ? "<div class=\"wide\"><table class=\"data\">" : "<div class=\"wide\"><table>";
  html += row_html(head, "th");
  for (const std::vector<std::string>& row : rows) html += row_html(row, "td");
  return html + "</table></div>\n";
}

std::string html_folded(std::string_view summary, std::string_view body) {
  return fmt::format("<details><summary>{}</summary>{}</details>\n", html_escaped(summary), body);
}

std::string html_details(const Table& table, const std::string& file) {
  if (table.rows() == 0) return fmt::format("<p>Data: <code>{}</code></p>\n", html_escaped(file));
  std::vector<std::vector<std::string>> rows(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (const std::string& column : table.columns()) rows[row].push_back(table.text(row, column));
  return html_folded(fmt::format("{} ({} rows)", file, table.rows()), html_table(table.columns(), rows, true));
}

}  // namespace fathom
