#include "core/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/files.h"
#include "tests/core/expect_error.h"
#include "tests/core/file_size_limit.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

template <class T>
bool same_bytes(const Image<T>& a, const Image<T>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.size() * sizeof(T)) == 0;
}

Image<float> floats(float start) {
  Image<float> image(5, 3);
  for (float& pixel : image.pixels()) pixel = start *= -1.7f;
  image(0, 0) = std::numeric_limits<float>::quiet_NaN();
  image(4, 2) = std::numeric_limits<float>::infinity();
  return image;
}

/// No two pixels alike, so that nothing is compressed away.
Image<float> floats_like(int width, int height) {
  Image<float> image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] = std::sin(static_cast<float>(i * i));
  return image;
}

TEST(Exr, EveryChannelComesBackBitForBit) {
  const TemporaryFolder folder;
  const Image<float> z = floats(0.1f), x = floats(3.0f);
  write_exr(folder / "a.exr", {{"position.Z", z}, {"position.X", x}});
  const std::vector<ExrChannel> channels = read_exr(folder / "a.exr");
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].name, "position.X");
  EXPECT_TRUE(same_bytes(channels[0].image, x));
  EXPECT_TRUE(same_bytes(read_exr_channel(folder / "a.exr", "position.Z"), z));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Exr, ErrorsNameTheFileAndTheChannels) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", {{"X", floats(1.0f)}, {"Z", floats(1.0f)}});
  expect_error([&] { read_exr_channel(folder / "a.exr", "Y"); }, {"a.exr", "unknown channel 'Y', choose from X, Z"});
  write_text(folder / "b.exr", "not an image");
  expect_error([&] { read_exr(folder / "b.exr"); }, {"b.exr", "cannot read as OpenEXR"});
  expect_error([&] { read_exr(folder / "none.exr"); }, {"none.exr"});
}

// The last of an OpenEXR file is written by destructors, which cannot say that they failed.
TEST(Exr, AFullDiskIsAnError) {
  const TemporaryFolder folder;
  for (const Image<float>& image : {Image<float>(64, 48, 1.0f), floats_like(64, 48)}) {
    write_exr(folder / "whole.exr", {{"Z", image}});
    const std::uintmax_t size = std::filesystem::file_size(folder / "whole.exr");
    for (const std::uintmax_t room : {size - 1, size - 100, size / 2, size / 10}) {
      const FileSizeLimit limit(room);
      EXPECT_THROW(write_exr(folder / "a.exr", {{"Z", image}}), Error) << room << " of " << size;
      EXPECT_EQ(folder.entries(), 1);
    }
  }
}

TEST(Png, IsWholeWhenNothingIsMissing) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", Image<Rgb>(40, 30, Rgb{1, 2, 3}));
  const std::string whole = read_text(folder / "a.png");
  EXPECT_TRUE(is_whole_png(folder / "a.png"));
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    write_text(folder / "b.png", whole.substr(0, size));
    EXPECT_FALSE(is_whole_png(folder / "b.png")) << size;
  }
}

TEST(Png, Grey16ComesBackExactly) {
  const TemporaryFolder folder;
  Image<std::uint16_t> image(300, 219);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] = static_cast<std::uint16_t>(i);
  ASSERT_GE(image.size(), 65536u);  // every value occurs
  write_png(folder / "a.png", image);
  EXPECT_TRUE(same_bytes(read_png_grey(folder / "a.png"), image));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Png, Grey8ComesBackExactly) {
  const TemporaryFolder folder;
  Image<std::uint8_t> image(16, 16);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] = static_cast<std::uint8_t>(i);
  write_png(folder / "a.png", image);
  const Image<std::uint16_t> read = read_png_grey(folder / "a.png");
  ASSERT_EQ(read.size(), image.size());
  for (std::size_t i = 0; i < image.size(); ++i) EXPECT_EQ(read.pixels()[i], i);
}

TEST(Png, WhatIsNoGreyPngIsRefusedSilently) {
  const TemporaryFolder folder;
  write_png(folder / "rgb.png", Image<Rgb>(2, 2));
  write_text(folder / "text.png", "not an image");
  Image<std::uint16_t> image(64, 64);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] = static_cast<std::uint16_t>(i * i);
  write_png(folder / "whole.png", image);
  const std::string whole = read_text(folder / "whole.png");
  write_text(folder / "cut.png", whole.substr(0, whole.size() / 2));

  testing::internal::CaptureStderr();
  expect_error([&] { read_png_grey(folder / "rgb.png"); }, {"rgb.png: is not a grey"});
  expect_error([&] { read_png_grey(folder / "text.png"); }, {"text.png: cannot read as PNG"});
  expect_error([&] { read_png_grey(folder / "cut.png"); }, {"cut.png: cannot read as PNG"});
  expect_error([&] { read_png_grey(folder / "none.png"); }, {"none.png: cannot be opened"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Png, EmptyImageLeavesNoFile) {
  const TemporaryFolder folder;
  expect_error([&] { write_png(folder / "a.png", Image<std::uint16_t>()); }, {"a.png: cannot write PNG"});
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace fathom
