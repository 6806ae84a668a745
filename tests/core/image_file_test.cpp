#include "core/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/files.h"
#include "core/input_policy.h"
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

template <class Number>
std::string raw(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

/// Joined by appending: of operator+ GCC 12 warns without a reason.
std::string joined(std::initializer_list<std::string> parts) {
  std::string all;
  for (const std::string& part : parts) all.append(part);
  return all;
}

const std::string kZero(1, '\0');

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return joined({name, kZero, type, kZero, raw(static_cast<std::int32_t>(value.size())), value});
}

std::string window(std::int32_t min_x, std::int32_t min_y, std::int32_t max_x, std::int32_t max_y) {
  return raw(min_x) + raw(min_y) + raw(max_x) + raw(max_y);
}

/// An EXR file's header, and a little more, as another program could write it.
struct ExrBytes {
  std::int32_t version = 2;
  std::string data_window = window(0, 0, 4, 3);
  int channels = 1;
  char compression = 3;  // ZIP
  std::string more{};    // attributes

  std::string text() const {
    std::string list;
    for (int i = 0; i < channels; ++i)
      list += joined({"c", std::to_string(i), kZero, raw(2), std::string(4, '\0'), raw(1), raw(1)});
    return joined({raw(20000630), raw(version), attribute("channels", "chlist", list + kZero),
                   attribute("compression", "compression", std::string(1, compression)),
                   attribute("dataWindow", "box2i", data_window),
                   attribute("displayWindow", "box2i", window(0, 0, 4, 3)), attribute("lineOrder", "lineOrder", kZero),
                   attribute("pixelAspectRatio", "float", raw(1.0f)),
                   attribute("screenWindowCenter", "v2f", raw(0.0f) + raw(0.0f)),
                   attribute("screenWindowWidth", "float", raw(1.0f)), more, kZero, std::string(100, '\0')});
  }
};

TEST(Exr, AnImageMayBeginAnywhere) {
  const TemporaryFolder folder;
  const Image<float> image = floats(0.1f);
  write_exr(folder / "a.exr", {{"Z", image}});
  std::string bytes = read_text(folder / "a.exr");
  constexpr std::int32_t kLeft = 1'000'000, kTop = -1'000'000;
  const std::string key = joined({"dataWindow", kZero, "box2i", kZero, raw(16)});
  bytes.replace(bytes.find(key) + key.size(), 16, window(kLeft, kTop, kLeft + 4, kTop + 2));
  // The one block of lines begins with its first line's number; the place of it stands in the eight bytes before.
  const auto points_behind = [&](std::size_t at) { return bytes.compare(at, 8, raw(std::uint64_t{at + 8})) == 0; };
  std::size_t block = 0;
  while (!points_behind(block)) ASSERT_LT(++block, bytes.size());
  bytes.replace(block + 8, 4, raw(kTop));
  write_text(folder / "a.exr", bytes);
  EXPECT_TRUE(same_bytes(read_exr_channel(folder / "a.exr", "Z"), image));
  EXPECT_NO_THROW(check_exr(folder / "a.exr", 5, 3));
}

TEST(Exr, AHeaderClaimsNoMoreThanTheLimitAndTheFileAllow) {
  const TemporaryFolder folder;
  const auto expect = [&](const ExrBytes& bytes, const std::string& message) {
    SCOPED_TRACE(message);
    write_text(folder / "a.exr", bytes.text());
    expect_error([&] { read_exr(folder / "a.exr"); }, {"a.exr: ", message});
  };
  expect({.data_window = window(0, 0, 59'999, 59'999)}, "header: promises 14.4 GB of pixels, at most 1 GB is read");
  expect({.data_window = window(0, 0, 639, 479), .channels = 2000}, "header: promises 2.46 GB of pixels");
  expect({.data_window = window(0, 0, 999, 999)}, "header: is truncated: 1000 × 1000 pixels of 1 channels");
  expect({.data_window = window(0, 0, 39, 39), .compression = 0}, "header: is truncated: 40 × 40 pixels");
  expect({.data_window = window(0, 0, -1, 5)}, "which is no image");
  expect({.data_window = window(5, 0, 3, 5)}, "which is no image");
  expect({.data_window = window(-2147483647, 0, 2147483647, 5)}, "which is no image");
  expect({.data_window = window(2000000000, 2000000000, 2000000004, 2000000004)}, "which is no image");
  expect({.channels = 0}, "no channels");
  for (const int flag : {0x200, 0x800, 0x1000}) expect({.version = 2 | flag}, "one part in scanlines is read");
  expect({.version = 3}, "another version");

  const std::string endless = joined({"comment", kZero, "string", kZero, raw(2'000'000'000)});
  expect({.more = endless}, "header: cannot read as OpenEXR: it is cut short");
  expect({.more = attribute("preview", "preview", raw(40'000) + raw(40'000))}, "the preview is larger");
  // OpenEXR reads sixteen bytes of a window, so that what follows would be another header to it: one that promises
  // more.
  const std::string short_window = joined({"dataWindow", kZero, "box2i", kZero, raw(9), std::string(9, '\0')});
  expect({.more = short_window}, "an attribute has another size than its type");
  expect({.more = attribute("more", "chlist", kZero + std::string(3, '\0'))}, "another size than its content");
  expect({.more = attribute("preview", "preview", raw(1) + raw(1) + std::string(5, '\0'))},
         "another size than its content");
  const std::string whole = ExrBytes().text();
  for (std::size_t length = 0; length + 100 < whole.size(); ++length) {
    write_text(folder / "a.exr", whole.substr(0, length));
    expect_error([&] { read_exr(folder / "a.exr"); }, {"a.exr: header: cannot read as OpenEXR"});
  }
}

TEST(Png, AHeaderClaimsNoMoreThanTheLimitAndTheFileAllow) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", Image<std::uint16_t>(4, 4));
  const std::string small = read_text(folder / "a.png");
  const auto big_endian = [](std::uint32_t number) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift);
    return bytes;
  };
  const auto expect = [&](std::uint32_t width, std::uint32_t height, const std::string& message) {
    std::string text = small;
    text.replace(16, 8, big_endian(width) + big_endian(height));
    std::uint32_t sum = ~0u;  // CRC-32 of the chunk
    for (std::size_t i = 12; i < 29; ++i) {
      sum ^= static_cast<unsigned char>(text[i]);
      for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1 ? 0xEDB88320u : 0u);
    }
    text.replace(29, 4, big_endian(~sum));
    write_text(folder / "b.png", text);
    expect_error([&] { read_png_grey(folder / "b.png"); }, {"b.png: ", message});
  };
  expect(65'000, 65'000, "header: promises 8.45 GB of pixels, at most 1 GB is read");
  expect(10'000, 10'000, "header: is truncated: 10000 × 10000 pixels cannot be packed in");
  expect(4, 5, "cannot read as PNG");
  write_text(folder / "empty.png", "");
  expect_error([&] { read_png_grey(folder / "empty.png"); }, {"empty.png: cannot read as PNG"});
  const InputPolicyScope scope({.most_bytes = 31});
  expect_error([&] { read_png_grey(folder / "a.png"); }, {"a.png: promises"});
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
  expect_error([&] { read_png_grey(folder / "none.png"); }, {"none.png: no such file"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Png, EmptyImageLeavesNoFile) {
  const TemporaryFolder folder;
  expect_error([&] { write_png(folder / "a.png", Image<std::uint16_t>()); }, {"a.png: cannot write PNG"});
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace fathom
