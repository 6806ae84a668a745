#include "core/table.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/input_policy.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

Table table_of(std::string_view text) {
  const TemporaryFolder folder;
  write_text(folder / "frames.csv", text);
  return read_table(folder / "frames.csv");
}

TEST(Table, ComesBackFromItsFile) {
  const TemporaryFolder folder;
  Table table({"liquid", "fill_mm"});
  table.add({"tea, with \"milk\"", "30"});
  table.add({"", "0.1"});
  table.add_column("height_mm");
  table.set(1, "height_mm", "9.21");
  write_table(folder / "t.csv", table);
  const Table read = read_table(folder / "t.csv");
  EXPECT_EQ(read.csv(), table.csv());
  EXPECT_EQ(read.text(0, "liquid"), "tea, with \"milk\"");
  EXPECT_EQ(read.number(1, "fill_mm"), 0.1);
  EXPECT_EQ(read.number(1, "height_mm"), 9.21);
  EXPECT_FALSE(read.number_if_any(0, "height_mm"));
}

TEST(Table, AcceptsWhatSpreadsheetsWrite) {
  const Table table = table_of(
      "\xEF\xBB\xBF"
      "a,b\r\n1,\"2\"\r\n\r\n");
  ASSERT_EQ(table.rows(), 1u);
  EXPECT_EQ(table.number(0, "a"), 1.0);
  EXPECT_EQ(table.number(0, "b"), 2.0);
}

TEST(Table, BlanksAroundCellsAndBlankLinesMeanNothing) {
  const Table table = table_of("liquid , fill_mm\n\nmilk tea ,\t10 \n , \nwater,deep\n \n\n");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.text(0, "liquid"), "milk tea");
  EXPECT_EQ(table.number(0, "fill_mm"), 10.0);
  expect_error([&] { table.number(1, "fill_mm"); }, {"frames.csv: line 5, column 'fill_mm'"});
}

TEST(Table, LinesAndCellsMayBePartedInAnyCommonWay) {
  for (const char* text : {"a,b\n1,+2.5\n,3e0\n", "a,b\r1,2.5\r,3\r", "a\tb\r\n1\t2.5\r\n\t3", "a;b\n1;2.5\n;3\n;\n",
                           "a,b,,\n1,2.5,,\n,3,,\n,,,\n", "a,b\n1,2.5,\n,3,,,\n"}) {
    const Table table = table_of(text);
    ASSERT_EQ(table.rows(), 2u) << text;
    EXPECT_EQ(table.number(0, "a"), 1.0) << text;
    EXPECT_EQ(table.number(0, "b"), 2.5) << text;
    EXPECT_FALSE(table.number_if_any(1, "a")) << text;
    EXPECT_EQ(table.number(1, "b"), 3.0) << text;
  }
}

TEST(Table, ErrorsNameFileLineAndColumn) {
  const Table table = table_of("frame,fill_mm\n1,10\n2,ten\n3,\n4,inf\n");
  expect_error([&] { table.number(1, "fill_mm"); },
               {"frames.csv: line 3, column 'fill_mm': must be a finite number, got 'ten'"});
  expect_error([&] { table.number(2, "fill_mm"); }, {"line 4, column 'fill_mm': is empty"});
  expect_error([&] { table.number(3, "fill_mm"); }, {"line 5", "finite"});
  expect_error([&] { table.number(0, "fil_mm"); }, {"line 1: has no column 'fil_mm', only frame,fill_mm"});
}

TEST(Table, BrokenTablesAreRefused) {
  expect_error([] { table_of(""); }, {"frames.csv: is empty, expected a header line"});
  expect_error([] { table_of("\n"); }, {"frames.csv: is empty, expected a header line"});
  expect_error(
      [] {
        table_of(
            std::string_view("\xFF\xFE"
                             "a\0,\0b\0",
                             8));
      },
      {"frames.csv: is no plain text (UTF-16? a workbook?), must be CSV in UTF-8"});
  expect_error([] { table_of("a,b\n1,2\n1,2,3\n"); }, {"frames.csv: line 3: has 3 cells, the header has 2"});
  expect_error([] { table_of("a,b,a\n"); }, {"line 1: has the column 'a' twice"});
  expect_error([] { table_of("a\n\"b\n"); }, {"line 2: has a quotation mark that is not closed"});
}

TEST(Table, ALineIsNoLongerThanAThousandLongCells) {
  const std::string line(1'000'001, 'x');
  expect_error([&] { table_of(line + "\n1\n"); }, {"frames.csv: line 1: is longer than 1000000 bytes"});
  expect_error([&] { table_of("a\n1\n" + line); }, {"frames.csv: line 3: is longer than 1000000 bytes"});
  EXPECT_EQ(table_of("a\n" + line.substr(1)).rows(), 1U);
}

/// What a table takes, not what its cells say: 200,000 lines of two letters are 400 kB and 40 MB.
TEST(Table, ItsLinesAndLongCellsCountAsMemory) {
  std::string narrow = "a\n", wide = "a\n";
  for (int i = 0; i < 200'000; ++i) narrow += "1\n";
  for (int i = 0; i < 100'000; ++i) wide += std::string(100, 'x') + '\n';
  const InputPolicyScope policy({.most_bytes = 30'000'000});
  expect_error([&] { table_of(narrow); }, {"frames.csv: promises 36 MB of cells, at most 30 MB is read"});
  expect_error([&] { table_of(wide); }, {"frames.csv: promises 37.8 MB of cells, at most 30 MB is read"});
}

TEST(Table, WhatFitsInACellComesBack) {
  const std::string nul("a\0b", 3);
  for (const std::string& text :
       {std::string("tea, \"iced\""), std::string("a;b\tc"), std::string("'"), std::string(""), std::string(" a"),
        std::string("a\t"), std::string("a\rb"), std::string("a\nb"), nul}) {
    const TemporaryFolder folder;
    Table table({"x", "liquid", "y"});
    table.add({"1", text, "2"});
    write_table(folder / "t.csv", table);
    std::string read = "nothing";
    try {
      read = read_table(folder / "t.csv").text(0, "liquid");
    } catch (const Error&) {
    }
    EXPECT_EQ(fits_in_cell(text), read == text) << text;
  }
}

}  // namespace
}  // namespace fathom
