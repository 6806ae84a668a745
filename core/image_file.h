// Images in files: OpenEXR (float, ZIP scanlines) and PNG (8 and 16 bit grey, 8 bit RGB).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files.h"
#include "core/image.h"

namespace fathom {

struct ExrChannel {
  std::string name;  ///< e.g. "Z", "position.X"
  Image<float> image;
};

/// One part, scanlines, 32-bit float, ZIP. All channels must have the same size. Written whole or not at all.
void write_exr(const std::filesystem::path& path, const std::vector<ExrChannel>& channels);

/// Every channel of a scanline file, converted to float, in the file's (alphabetical) order.
/// Throws Error when the file cannot be read as OpenEXR.
std::vector<ExrChannel> read_exr(const std::filesystem::path& path);

/// Throws Error unless the file is an OpenEXR image of that size [px] whose last line can be read: what was cut short
/// has none. Damage in between shows when the file is read.
void check_exr(const std::filesystem::path& path, int width, int height);

/// The channel of that name; throws Error with the names that exist.
Image<float> read_exr_channel(const std::filesystem::path& path, const std::string& name);

using Rgb = std::array<std::uint8_t, 3>;

void write_png(const std::filesystem::path& path, const Image<std::uint8_t>& grey, Flush flush = Flush::at_once);

/// How 16 bits are packed. In noise nothing repeats, and to look for it takes twice the time and a tenth more space.
enum class Packing { noise, repeats };
void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& grey, Flush flush = Flush::at_once,
               Packing packing = Packing::noise);

void write_png(const std::filesystem::path& path, const Image<Rgb>& rgb, Flush flush = Flush::at_once);

/// What such a file would hold.
std::string png_bytes(const Image<std::uint8_t>& grey);

/// 16-bit grey; 8-bit files are read as they are (0…255). Throws Error when the file is no grey PNG.
Image<std::uint16_t> read_png_grey(const std::filesystem::path& path);

/// Whether the file is a PNG of any kind whose every row and end can be read.
bool is_whole_png(const std::filesystem::path& path);

}  // namespace fathom
