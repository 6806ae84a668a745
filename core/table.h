// CSV tables with a header line. Cells are text; numbers are asked for, with errors that name line and column.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

class Table {
 public:
  explicit Table(std::vector<std::string> columns, std::string file = "")
      : columns_(std::move(columns)), file_(std::move(file)) {}

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t rows() const { return cells_.size(); }
  const std::string& file() const { return file_; }

  bool has(std::string_view column) const;
  /// Throws Error when the column is missing.
  void need(std::string_view column) const;
  /// Throws Error when the column is missing.
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Throws Error when the cell is no finite number.
  double number(std::size_t row, std::string_view column) const;
  /// As number(), but nothing when the cell is empty.
  std::optional<double> number_if_any(std::size_t row, std::string_view column) const;

  /// `cells` in the order of the columns; without a `line` of a file they stand below those before.
  void add(std::vector<std::string> cells, std::optional<std::size_t> line = {});
  void add_column(std::string name);
  void set(std::size_t row, std::string_view column, std::string value);

  /// "line 12, column 'fill_mm'"
  std::string place(std::size_t row, std::string_view column) const;
  /// "frames.csv: line 12, column 'fill_mm': …"
  [[noreturn]] void fail(std::size_t row, std::string_view column, std::string_view what) const;

  std::string csv() const;

 private:
  std::size_t index(std::string_view column) const;

  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::size_t> lines_;  // of the file, from 1
  std::string file_;
};

/// RFC 4180 without line breaks inside cells; cells may be parted by tabs or semicolons as well, lines end in any way.
/// Empty cells beyond the header's and blank lines do not count. Throws Error on a missing header, double
/// columns, ragged lines and what is no text.
Table read_table(const std::filesystem::path& path);

/// Whether a cell with this text is read as it was written: without line breaks, NUL, and blanks at its ends.
bool fits_in_cell(std::string_view text);

void write_table(const std::filesystem::path& path, const Table& table);

}  // namespace fathom
