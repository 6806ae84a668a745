#include "core/image_file.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

#include "core/error.h"
#include "core/files.h"

namespace fathom {
namespace {

template <class Pixel>
void write_png_rows(const std::filesystem::path& path, const Image<Pixel>& image, std::uint32_t format) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = format;
  write_atomically(path, [&](const std::filesystem::path& beside) {
    if (!png_image_write_to_file(&header, beside.c_str(), 0, image.pixels().data(), 0, nullptr))
      throw Error(path.string(), std::string("cannot write PNG: ") + header.message);
  });
}

/// A PNG file and libpng's state of it. libpng leaves on errors by longjmp, so the functions that call setjmp hold no
/// objects with destructors of their own, and its messages are kept here instead of going to stderr.
class PngFile {
 public:
  enum class Mode { kRead, kWrite };

  PngFile(const std::filesystem::path& path, Mode mode) : mode_(mode) {
    file = std::fopen(path.c_str(), mode == Mode::kRead ? "rb" : "wb");
    if (!file) throw Error(path.string(), "cannot be opened");
    png = mode == Mode::kRead ? png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)
                              : png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png) info = png_create_info_struct(png);
    if (info) return;
    release();
    throw std::bad_alloc();
  }
  ~PngFile() { release(); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  /// False when what is still buffered does not reach the disk.
  bool close() { return std::fclose(std::exchange(file, nullptr)) == 0; }
  const char* problem() const { return problem_.data(); }

  std::FILE* file = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;

 private:
  static void on_error(png_structp png, png_const_charp message) {
    auto& problem = static_cast<PngFile*>(png_get_error_ptr(png))->problem_;
    std::snprintf(problem.data(), problem.size(), "%s", message);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}

  void release() {
    if (mode_ == Mode::kRead)
      png_destroy_read_struct(&png, &info, nullptr);
    else
      png_destroy_write_struct(&png, &info);
    if (file) std::fclose(file);
  }

  Mode mode_;
  std::array<char, 160> problem_{};
};

bool write_grey16(PngFile& to, const Image<std::uint16_t>& image) {
  if (setjmp(png_jmpbuf(to.png))) return false;
  png_init_io(to.png, to.file);
  png_set_IHDR(to.png, to.info, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()), 16,
               PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(to.png, 3);
  png_write_info(to.png, to.info);
  png_set_swap(to.png);
  for (int y = 0; y < image.height(); ++y) png_write_row(to.png, reinterpret_cast<png_const_bytep>(image.row(y)));
  png_write_end(to.png, to.info);
  return true;
}

/// libpng's simplified interface gamma-converts 16-bit data; depth and intensity are plain numbers and must not be.
void write_png_grey16(const std::filesystem::path& path, const Image<std::uint16_t>& image) {
  write_atomically(path, [&](const std::filesystem::path& beside) {
    PngFile to(beside, PngFile::Mode::kWrite);
    if (!write_grey16(to, image)) throw Error(path.string(), fmt::format("cannot write PNG: {}", to.problem()));
    if (!to.close()) throw Error(path.string(), "cannot write PNG: disk full or not writable");
  });
}

bool read_header(PngFile& from) {
  if (setjmp(png_jmpbuf(from.png))) return false;
  png_init_io(from.png, from.file);
  png_read_info(from.png, from.info);
  return true;
}

bool read_rows(PngFile& from, Image<std::uint16_t>& image, std::vector<std::uint8_t>& row) {
  if (setjmp(png_jmpbuf(from.png))) return false;
  const bool wide = png_get_bit_depth(from.png, from.info) == 16;
  if (wide) png_set_swap(from.png);
  for (int y = 0; y < image.height(); ++y) {
    png_read_row(from.png, row.data(), nullptr);
    if (wide)
      std::memcpy(image.row(y), row.data(), row.size());
    else
      std::copy(row.begin(), row.end(), image.row(y));
  }
  return true;
}

bool read_to_the_end(PngFile& from, std::vector<std::uint8_t>& row) {
  if (setjmp(png_jmpbuf(from.png))) return false;
  const int passes = png_set_interlace_handling(from.png);
  png_read_update_info(from.png, from.info);
  row.resize(png_get_rowbytes(from.png, from.info));
  for (int pass = 0; pass < passes; ++pass)
    for (png_uint_32 y = 0; y < png_get_image_height(from.png, from.info); ++y)
      png_read_row(from.png, row.data(), nullptr);
  png_read_end(from.png, nullptr);
  return true;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const std::vector<ExrChannel>& channels) {
  assert(!channels.empty());
  const int width = channels.front().image.width();
  const int height = channels.front().image.height();
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (const ExrChannel& channel : channels) {
    assert(channel.image.width() == width && channel.image.height() == height);
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    // OpenEXR's Slice takes a mutable pointer but only reads through it when writing.
    auto* base = const_cast<char*>(reinterpret_cast<const char*>(channel.image.pixels().data()));
    frame.insert(channel.name, Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * width));
  }
  // Into memory first: what OpenEXR's destructors write to a full disk is lost without a word.
  Imf::StdOSStream bytes;
  {
    Imf::OutputFile file(bytes, header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  write_text(path, bytes.str());
}

std::vector<ExrChannel> read_exr(const std::filesystem::path& path) try {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const int width = window.max.x - window.min.x + 1;
  const int height = window.max.y - window.min.y + 1;
  std::vector<ExrChannel> channels;
  for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it)
    channels.push_back({it.name(), Image<float>(width, height)});
  Imf::FrameBuffer frame;
  for (ExrChannel& channel : channels) {
    char* origin = reinterpret_cast<char*>(channel.image.pixels().data()) -
                   sizeof(float) * (window.min.x + static_cast<std::ptrdiff_t>(window.min.y) * width);
    frame.insert(channel.name, Imf::Slice(Imf::FLOAT, origin, sizeof(float), sizeof(float) * width));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return channels;
} catch (const Error&) {
  throw;
} catch (const std::exception& problem) {
  throw Error(path.string(), std::string("cannot read as OpenEXR: ") + problem.what());
}

Image<float> read_exr_channel(const std::filesystem::path& path, const std::string& name) {
  std::vector<std::string> names;
  for (ExrChannel& channel : read_exr(path)) {
    if (channel.name == name) return std::move(channel.image);
    names.push_back(channel.name);
  }
  throw Error(path.string(), unknown_name("channel", name, names));
}

void write_png(const std::filesystem::path& path, const Image<std::uint8_t>& grey) {
  write_png_rows(path, grey, PNG_FORMAT_GRAY);
}

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& grey) { write_png_grey16(path, grey); }

void write_png(const std::filesystem::path& path, const Image<Rgb>& rgb) { write_png_rows(path, rgb, PNG_FORMAT_RGB); }

Image<std::uint16_t> read_png_grey(const std::filesystem::path& path) {
  PngFile from(path, PngFile::Mode::kRead);
  const auto fail = [&] { throw Error(path.string(), fmt::format("cannot read as PNG: {}", from.problem())); };
  if (!read_header(from)) fail();
  const int depth_bits = png_get_bit_depth(from.png, from.info);
  if (png_get_color_type(from.png, from.info) != PNG_COLOR_TYPE_GRAY || (depth_bits != 8 && depth_bits != 16) ||
      png_get_interlace_type(from.png, from.info) != PNG_INTERLACE_NONE)
    throw Error(path.string(), "is not a grey, non-interlaced PNG of 8 or 16 bits");
  Image<std::uint16_t> image(static_cast<int>(png_get_image_width(from.png, from.info)),
                             static_cast<int>(png_get_image_height(from.png, from.info)));
  std::vector<std::uint8_t> row(png_get_rowbytes(from.png, from.info));
  if (!read_rows(from, image, row)) fail();
  return image;
}

bool is_whole_png(const std::filesystem::path& path) {
  PngFile from(path, PngFile::Mode::kRead);
  std::vector<std::uint8_t> row;
  return read_header(from) && read_to_the_end(from, row);
}

}  // namespace fathom
