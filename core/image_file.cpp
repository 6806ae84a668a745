#include "core/image_file.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

#include "core/error.h"
#include "core/exr_header.h"
#include "core/files.h"
#include "core/input_policy.h"

namespace fathom {
namespace {

template <class Pixel>
png_image png_header(const Image<Pixel>& image, std::uint32_t format) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = format;
  return header;
}

template <class Pixel>
void write_png_rows(const std::filesystem::path& path, const Image<Pixel>& image, std::uint32_t format,
                    std::uint32_t flags, Flush flush) {
  png_image header = png_header(image, format);
  header.flags = flags;
  const auto write = [&](const std::filesystem::path& beside) {
    if (!png_image_write_to_file(&header, beside.c_str(), 0, image.pixels().data(), 0, nullptr))
      throw Error(path.string(), fmt::format("cannot write PNG: {} (disk full or not writable)",
                                             static_cast<const char*>(header.message)));
  };
  write_atomically(path, write, flush);
}

/// A file's content for OpenEXR.
class BytesOfFile : public Imf::IStream {
 public:
  BytesOfFile(const std::string& name, std::string_view bytes) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (at_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - at_)
      throw std::runtime_error("early end of file");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// The content, once its header was checked: OpenEXR trusts it.
std::string read_checked_exr(const std::filesystem::path& path) {
  std::string content = read_text(path);
  check_exr_header(path.string(), content);
  return content;
}

struct ExrFile {
  explicit ExrFile(const std::filesystem::path& path)
      : content(read_checked_exr(path)), bytes(path.string(), content), file(bytes) {}

  std::string content;
  BytesOfFile bytes;
  Imf::InputFile file;
};

/// A PNG file and libpng's state of it. libpng leaves on errors by longjmp, so the functions that call setjmp hold no
/// objects with destructors of their own, and its messages are kept here instead of going to stderr.
class PngFile {
 public:
  enum class Mode { kRead, kWrite };

  explicit PngFile(const std::filesystem::path& path) : PngFile(path, std::fopen(path.c_str(), "wb"), Mode::kWrite) {}
  /// Reads from `content`, which outlives this.
  PngFile(const std::filesystem::path& path, std::string& content)
      : PngFile(path, ::fmemopen(content.data(), content.size(), "rb"), Mode::kRead) {}
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
  PngFile(const std::filesystem::path& path, std::FILE* opened, Mode mode) : file(opened), mode_(mode) {
    if (!file) throw Error(path.string(), "cannot be opened");
    png = mode == Mode::kRead ? png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)
                              : png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png) info = png_create_info_struct(png);
    if (info) return;
    release();
    throw std::bad_alloc();
  }

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

bool write_grey16(PngFile& to, const Image<std::uint16_t>& image, Packing packing) {
  if (setjmp(png_jmpbuf(to.png))) return false;
  png_init_io(to.png, to.file);
  png_set_IHDR(to.png, to.info, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()), 16,
               PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Trying every filter on every row takes longer than compressing and gains nothing on depths, which run on along
  // rows.
  png_set_filter(to.png, 0, PNG_FILTER_SUB);
  png_set_compression_level(to.png, 2);
  png_set_compression_strategy(to.png, packing == Packing::noise ? Z_RLE : Z_DEFAULT_STRATEGY);
  png_write_info(to.png, to.info);
  png_set_swap(to.png);
  for (int y = 0; y < image.height(); ++y) png_write_row(to.png, reinterpret_cast<png_const_bytep>(image.row(y)));
  png_write_end(to.png, to.info);
  return true;
}

bool read_header(PngFile& from) {
  if (setjmp(png_jmpbuf(from.png))) return false;
  png_init_io(from.png, from.file);
  // Neither texts nor profiles are unpacked: a hundred of them in 1 MB make 800.
  png_set_keep_unknown_chunks(from.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
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

/// Where the pixel (0, 0) of an image would lie whose pixel (`left`, `top`) lies at `first`. A file may begin anywhere,
/// so it may be outside of all memory: numbers, unlike pointers, are allowed to be.
char* pixel_zero(float* first, int left, int top, int width) {
  const std::uint64_t before =
      static_cast<std::uint64_t>(left) + static_cast<std::uint64_t>(top) * static_cast<std::uint64_t>(width);
  return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(first) - sizeof(float) * before);
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

void check_exr(const std::filesystem::path& path, int width, int height) try {
  ExrFile exr(path);
  const Imath::Box2i window = exr.file.header().dataWindow();
  const std::int64_t wide = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t high = std::int64_t{window.max.y} - window.min.y + 1;
  if (wide != width || high != height)
    throw Error(path.string(), fmt::format("is {} × {} pixels, expected {} × {}", wide, high, width, height));
  std::vector<float> line(static_cast<std::size_t>(width));
  Imf::FrameBuffer frame;
  const auto channel = exr.file.header().channels().begin();  // a checked header has one
  frame.insert(channel.name(), Imf::Slice(Imf::FLOAT, pixel_zero(line.data(), window.min.x, 0, 0), sizeof(float),
                                          0));  // the same line for every y
  exr.file.setFrameBuffer(frame);
  exr.file.readPixels(window.max.y);
} catch (const Error&) {
  throw;
} catch (const std::exception& problem) {
  throw Error(path.string(), std::string("cannot read as OpenEXR: ") + problem.what());
}

std::vector<ExrChannel> read_exr(const std::filesystem::path& path) try {
  ExrFile exr(path);
  Imf::InputFile& file = exr.file;
  const Imath::Box2i window = file.header().dataWindow();
  const int width = window.max.x - window.min.x + 1;
  const int height = window.max.y - window.min.y + 1;
  std::vector<ExrChannel> channels;
  for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it)
    channels.push_back({it.name(), Image<float>(width, height)});
  Imf::FrameBuffer frame;
  for (ExrChannel& channel : channels)
    frame.insert(channel.name,
                 Imf::Slice(Imf::FLOAT, pixel_zero(channel.image.pixels().data(), window.min.x, window.min.y, width),
                            sizeof(float), sizeof(float) * width));
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

void write_png(const std::filesystem::path& path, const Image<std::uint8_t>& grey, Flush flush) {
  write_png_rows(path, grey, PNG_FORMAT_GRAY, PNG_IMAGE_FLAG_FAST, flush);
}

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& grey, Flush flush, Packing packing) {
  // libpng's simplified interface gamma-converts 16-bit data; depth and intensity are plain numbers and must not be.
  const auto write = [&](const std::filesystem::path& beside) {
    PngFile to(beside);
    if (!write_grey16(to, grey, packing)) throw Error(path.string(), fmt::format("cannot write PNG: {}", to.problem()));
    if (!to.close()) throw Error(path.string(), "cannot write PNG: disk full or not writable");
  };
  write_atomically(path, write, flush);
}

void write_png(const std::filesystem::path& path, const Image<Rgb>& rgb, Flush flush) {
  write_png_rows(path, rgb, PNG_FORMAT_RGB, 0, flush);
}

std::string png_bytes(const Image<std::uint8_t>& grey) {
  png_image header = png_header(grey, PNG_FORMAT_GRAY);
  header.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, grey.pixels().data(), 0, nullptr))
    throw std::runtime_error(std::string("cannot write PNG: ") + header.message);
  bytes.resize(size);
  return bytes;
}

Image<std::uint16_t> read_png_grey(const std::filesystem::path& path) {
  std::string content = read_text(path);
  if (content.empty()) throw Error(path.string(), "cannot read as PNG: it is empty");
  PngFile from(path, content);
  const auto fail = [&] { throw Error(path.string(), fmt::format("cannot read as PNG: {}", from.problem())); };
  if (!read_header(from)) fail();
  const int depth_bits = png_get_bit_depth(from.png, from.info);
  if (png_get_color_type(from.png, from.info) != PNG_COLOR_TYPE_GRAY || (depth_bits != 8 && depth_bits != 16) ||
      png_get_interlace_type(from.png, from.info) != PNG_INTERLACE_NONE)
    throw Error(path.string(), "is not a grey, non-interlaced PNG of 8 or 16 bits");
  constexpr std::uint64_t kMostPacked = 1032;  // bytes that one byte of deflate can stand for (zlib's manual)
  const std::uint64_t width = png_get_image_width(from.png, from.info),
                      height = png_get_image_height(from.png, from.info),
                      row_bytes = png_get_rowbytes(from.png, from.info);
  require_within_limit(path.string(), "header", bytes_of({width, height, sizeof(std::uint16_t)}), "pixels");
  if (bytes_of({row_bytes, height}) > bytes_of({content.size(), kMostPacked}))
    throw Error(
        path.string(), "header",
        fmt::format("is truncated: {} × {} pixels cannot be packed in {} bytes", width, height, content.size()));
  Image<std::uint16_t> image(static_cast<int>(width), static_cast<int>(height));
  std::vector<std::uint8_t> row(row_bytes);
  if (!read_rows(from, image, row)) fail();
  return image;
}

bool is_whole_png(const std::filesystem::path& path) {
  std::string content = read_text(path);
  if (content.empty()) return false;
  PngFile from(path, content);
  std::vector<std::uint8_t> row;
  return read_header(from) && read_to_the_end(from, row);
}

}  // namespace fathom
