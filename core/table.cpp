#include "core/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/decimal.h"
#include "core/error.h"
#include "core/files.h"
#include "core/input_policy.h"

namespace fathom {
namespace {

/// Without the blanks that people and spreadsheets leave around a cell.
std::string trimmed(const std::string& cell) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = cell.find_first_not_of(kBlanks);
  return first == std::string::npos ? std::string() : cell.substr(first, cell.find_last_not_of(kBlanks) - first + 1);
}

/// What a table takes of memory beside its file: a line and a cell of it, and the text of a cell that is long.
std::uint64_t claimed_bytes(std::string_view text, std::uint64_t cells) {
  constexpr std::uint64_t kLine = 128, kCell = sizeof(std::string) + 16;
  const auto ends_line = [](char c) { return c == '\n' || c == '\r'; };
  const auto lines = static_cast<std::uint64_t>(std::count_if(text.begin(), text.end(), ends_line));
  return bytes_of({text.size(), 2}) + bytes_of({lines, kLine}) + bytes_of({cells, kCell});
}

/// Takes the first line off, whichever of "\n", "\r\n" and "\r" ends it.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
  return line;
}

/// Where a comma is the decimal sign, spreadsheets part cells by semicolons.
char separator_of(std::string_view header) {
  for (const char separator : {',', '\t', ';'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::vector<std::string> split_line(std::string_view line, char separator, std::string_view file, std::size_t number) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[i++];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) throw Error(file, fmt::format("line {}", number), "has a quotation mark that is not closed");
  std::transform(cells.begin(), cells.end(), cells.begin(), trimmed);
  return cells;
}

std::string quoted_if_needed(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string result = "\"";
  for (const char c : cell) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    line += quoted_if_needed(cell);
  }
  return line + '\n';
}

}  // namespace

bool Table::has(std::string_view column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

void Table::need(std::string_view column) const { index(column); }

std::size_t Table::index(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end())
    throw Error(
        file_, "line 1",
        fmt::format("has no column '{}', only {}", column, joined(columns_).substr(0, joined(columns_).size() - 1)));
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& Table::text(std::size_t row, std::string_view column) const { return cells_.at(row)[index(column)]; }

double Table::number(std::size_t row, std::string_view column) const {
  const std::optional<double> value = number_if_any(row, column);
  if (!value) fail(row, column, "is empty, a number is needed");
  return *value;
}

std::optional<double> Table::number_if_any(std::size_t row, std::string_view column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) return std::nullopt;
  const std::optional<double> value = decimal<double>(cell);
  if (!value) fail(row, column, fmt::format("must be a finite number, got '{}'", cell));
  return value;
}

void Table::add(std::vector<std::string> cells, std::optional<std::size_t> line) {
  lines_.push_back(line.value_or(lines_.empty() ? 2 : lines_.back() + 1));
  cells.resize(columns_.size());
  cells_.push_back(std::move(cells));
}

void Table::add_column(std::string name) {
  columns_.push_back(std::move(name));
  for (auto& row : cells_) row.emplace_back();
}

void Table::set(std::size_t row, std::string_view column, std::string value) {
  cells_.at(row)[index(column)] = std::move(value);
}

void Table::fail(std::size_t row, std::string_view column, std::string_view what) const {
  throw Error(file_, place(row, column), what);
}

std::string Table::place(std::size_t row, std::string_view column) const {
  return fmt::format("line {}, column '{}'", lines_.at(row), column);
}

std::string Table::csv() const {
  std::string text = joined(columns_);
  for (const auto& row : cells_) text += joined(row);
  return text;
}

Table read_table(const std::filesystem::path& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets put it before UTF-8
  constexpr std::string_view kBlank = " \t\r\n,;\"";
  const std::string content = read_text(path), file = path.string();
  std::string_view text = content;
  if (text.find('\0') != std::string_view::npos)
    throw Error(file, "is no plain text (UTF-16? a workbook?), must be CSV in UTF-8");
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.find_first_not_of(kBlank) == std::string_view::npos) throw Error(file, "is empty, expected a header line");
  const std::string_view header = take_line(text);
  const char separator = separator_of(header);
  const auto ends_cell = [&](char c) { return c == separator || c == '\n' || c == '\r'; };
  const auto most_cells = static_cast<std::uint64_t>(std::count_if(text.begin(), text.end(), ends_cell));
  require_within_limit(file, "", claimed_bytes(text, most_cells), "cells");
  const auto require_short = [&](std::string_view line, std::size_t number) {
    constexpr std::size_t kLongest = 1'000'000;  // a thousand columns of a thousand letters
    if (line.size() > kLongest)
      throw Error(file, fmt::format("line {}", number), fmt::format("is longer than {} bytes", kLongest));
  };
  constexpr std::ptrdiff_t kMostColumns = 1000;
  if (std::count(header.begin(), header.end(), separator) >= kMostColumns)
    throw Error(file, "line 1", fmt::format("has more than {} columns", kMostColumns));
  require_short(header, 1);
  Table table(split_line(header, separator, file, 1), file);
  for (auto column = table.columns().begin(); column != table.columns().end(); ++column)
    if (!column->empty() && std::find(std::next(column), table.columns().end(), *column) != table.columns().end())
      throw Error(file, "line 1", fmt::format("has the column '{}' twice", *column));
  const char* const end = text.data() + (text.find_last_not_of(kBlank) + 1);  // npos + 1 is 0
  for (std::size_t number = 2; text.data() < end; ++number) {
    const std::string_view line = take_line(text);
    if (line.find_first_not_of(kBlank) == std::string_view::npos) continue;
    require_short(line, number);
    std::vector<std::string> cells = split_line(line, separator, file, number);
    while (cells.size() > table.columns().size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != table.columns().size())
      throw Error(file, fmt::format("line {}", number),
                  fmt::format("has {} cells, the header has {}", cells.size(), table.columns().size()));
    table.add(std::move(cells), number);
  }
  return table;
}

bool fits_in_cell(std::string_view text) {
  constexpr std::string_view kBreaks("\n\r\0", 3);
  return text.find_first_of(kBreaks) == std::string_view::npos && trimmed(std::string(text)) == text;
}

void write_table(const std::filesystem::path& path, const Table& table) { write_text(path, table.csv()); }

}  // namespace fathom
