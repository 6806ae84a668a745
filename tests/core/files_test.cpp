#include "core/files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/cloud_file.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

TEST(Files, AppearWhole) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "one\n");
  write_text(folder / "a.txt", "two\n");
  EXPECT_EQ(read_text(folder / "a.txt"), "two\n");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Files, LeaveNothingWhenTheWriterThrows) {
  const TemporaryFolder folder;
  const auto half_written = [](const std::filesystem::path& beside) {
    std::ofstream(beside) << "half";
    throw std::runtime_error("out of paper");
  };
  expect_error([&] { write_atomically(folder / "a.txt", half_written); },
               {(folder / "a.txt").string() + ": cannot be written: out of paper"});
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Files, KeepTheirOldContentWhenTheWriterThrows) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  const auto fails = [](const std::filesystem::path& beside) {
    std::ofstream(beside) << "new";
    throw Error("a.txt", "no");
  };
  EXPECT_THROW(write_atomically(folder / "a.txt", fails), Error);
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Files, AreWrittenBesideWithTheSameExtension) {
  const TemporaryFolder folder;
  write_atomically(folder / "image.exr", [&](const std::filesystem::path& beside) {
    EXPECT_EQ(beside.extension(), ".exr");
    EXPECT_EQ(beside.parent_path(), (folder / "image.exr").parent_path());
    std::ofstream(beside) << "x";
  });
}

TEST(Files, SayWhyTheyCannotBe) {
  const TemporaryFolder folder;
  make_directory(folder / "d");
  write_text(folder / "f", "");
  expect_error([&] { write_text(folder / "no/a.txt", ""); }, {"no/a.txt", "folder does not exist"});
  expect_error([&] { write_text(folder / "d", ""); }, {"a folder of that name exists"});
  expect_error([&] { read_text(folder / "missing"); }, {"missing: no such file"});
  expect_error([&] { read_text(folder / "d"); }, {"is a folder"});
  expect_error([&] { make_directory(folder / "f"); }, {"/f: cannot be created as a folder"});
  EXPECT_EQ(read_text(folder / "f"), "");
}

TEST(CloudFile, IsBinaryPcdWithOnePointPerPixel) {
  const TemporaryFolder folder;
  write_pcd(folder / "c.pcd", Image<CloudPoint>(4, 3, {1.0f, 2.0f, 3.0f, 4.0f}));
  const std::string text = read_text(folder / "c.pcd");
  const std::string last_line = "DATA binary\n";
  const std::size_t body = text.find(last_line) + last_line.size();
  EXPECT_NE(text.find("WIDTH 4\nHEIGHT 3\n"), std::string::npos);
  EXPECT_EQ(text.size() - body, 4u * 3u * 16u);
}

}  // namespace
}  // namespace fathom
