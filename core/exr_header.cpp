// By hand, because OpenEXR 3.1 takes the memory that attributes and previews promise while it reads the header, before
// anybody could ask how much that is. Layout: "OpenEXR File Layout", openexr.com.
#include "core/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/input_policy.h"

namespace fathom {
namespace {

struct Window {
  std::int32_t min_x, min_y, max_x, max_y;
};

/// What the checks need of a header.
struct Facts {
  std::optional<Window> window;
  std::uint64_t channels = 0;
  std::uint64_t pixel_bytes = 0;  ///< in the file, unpacked
  std::uint8_t compression = 0;
};

class HeaderBytes {
 public:
  HeaderBytes(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  [[noreturn]] void fail(std::string_view what) const {
    throw Error(file_, "header", fmt::format("cannot read as OpenEXR: {}", what));
  }
  std::string_view take(std::size_t count) {
    if (count > rest_.size()) fail("it is cut short");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  template <class Number>
  Number number() {  // the file is little-endian, as is every machine that Fathom runs on
    Number value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  /// Up to its end, a zero byte; empty at the end of a list.
  std::string_view name() {
    constexpr std::size_t kLongest = 255;
    const std::size_t length = rest_.find('\0');
    if (length == std::string_view::npos || length > kLongest) fail("a name has no end");
    const std::string_view taken = take(length);
    take(1);
    return taken;
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  const std::string& file_;
};

/// Bytes of a value of that type. OpenEXR reads as many, whatever size the file says: who went by the file's would read
/// another header than OpenEXR does.
std::optional<std::int32_t> size_of(std::string_view type) {
  using Sized = std::pair<std::string_view, std::int32_t>;
  constexpr std::array kSized{Sized{"box2f", 16},
                              Sized{"box2i", 16},
                              Sized{"chromaticities", 32},
                              Sized{"compression", 1},
                              Sized{"deepImageState", 1},
                              Sized{"double", 8},
                              Sized{"envmap", 1},
                              Sized{"float", 4},
                              Sized{"int", 4},
                              Sized{"keycode", 28},
                              Sized{"lineOrder", 1},
                              Sized{"m33d", 72},
                              Sized{"m33f", 36},
                              Sized{"m44d", 128},
                              Sized{"m44f", 64},
                              Sized{"rational", 8},
                              Sized{"tiledesc", 9},
                              Sized{"timecode", 8},
                              Sized{"v2d", 16},
                              Sized{"v2f", 8},
                              Sized{"v2i", 8},
                              Sized{"v3d", 24},
                              Sized{"v3f", 12},
                              Sized{"v3i", 12}};
  const auto known =
      std::find_if(kSized.begin(), kSized.end(), [&](const Sized& sized) { return sized.first == type; });
  return known == kSized.end() ? std::nullopt : std::optional(known->second);
}

void read_channels(HeaderBytes& bytes, Facts& facts) {
  constexpr std::int32_t kHalf = 1;
  while (!bytes.name().empty()) {
    const auto type = bytes.number<std::int32_t>();
    bytes.take(4);  // whether it is linear to the eye
    const auto across = bytes.number<std::int32_t>(), down = bytes.number<std::int32_t>();
    if (type < 0 || type > 2) bytes.fail("a channel is of an unknown type");
    if (across != 1 || down != 1) bytes.fail("a channel has other pixels than the image");
    ++facts.channels;
    facts.pixel_bytes += type == kHalf ? 2 : 4;
  }
}

void read_preview(HeaderBytes& bytes) {
  const auto width = bytes.number<std::uint32_t>(), height = bytes.number<std::uint32_t>();
  const std::uint64_t pixels = bytes_of({4, width, height});
  if (pixels > bytes.left()) bytes.fail("the preview is larger than its attribute");
  bytes.take(pixels);
}

Facts read_facts(HeaderBytes bytes) {
  constexpr std::int32_t kMagic = 20000630;
  constexpr std::uint32_t kVersion = 0xff, kTiled = 0x200, kDeep = 0x800, kParts = 0x1000;
  if (bytes.left() < 4 || bytes.number<std::int32_t>() != kMagic) bytes.fail("it does not begin as such a file");
  const auto version = bytes.number<std::uint32_t>();
  if ((version & kVersion) != 2) bytes.fail("it is of another version than 2");
  if (version & (kTiled | kDeep | kParts))
    bytes.fail("it has tiles, deep pixels or several parts; one part in scanlines is read");
  Facts facts;
  for (std::string_view name = bytes.name(); !name.empty(); name = bytes.name()) {
    const std::string_view type = bytes.name();
    const auto size = bytes.number<std::int32_t>();
    if (size < 0) bytes.fail("an attribute has a size below 0");
    if (size_of(type).value_or(size) != size) bytes.fail("an attribute has another size than its type");
    HeaderBytes value = bytes;
    bytes.take(static_cast<std::size_t>(size));
    if (name == "dataWindow" && type == "box2i") facts.window = value.number<Window>();
    if (name == "compression" && type == "compression") facts.compression = value.number<std::uint8_t>();
    if (type != "chlist" && type != "preview") continue;
    Facts of_another;
    if (type == "chlist") read_channels(value, name == "channels" ? facts : of_another);
    if (type == "preview") read_preview(value);
    if (value.left() != bytes.left()) bytes.fail("an attribute has another size than its content");
  }
  return facts;
}

/// By how much a compression can make bytes fewer, at most; nothing where it is not known.
std::optional<std::uint64_t> most_packed(std::uint8_t compression) {
  constexpr std::uint64_t kDeflate = 1032, kRuns = 64;  // zlib's manual; 128 equal bytes are two
  switch (compression) {
    case 0:
      return 1;
    case 1:
      return kRuns;
    case 2:
    case 3:
      return kDeflate;
    default:
      return std::nullopt;
  }
}

}  // namespace

void check_exr_header(const std::string& file, std::string_view content) {
  const Facts facts = read_facts(HeaderBytes(content, file));
  const auto fail = [&](const std::string& what) { throw Error(file, "header", what); };
  if (!facts.window || facts.channels == 0) fail("cannot read as OpenEXR: it has no dataWindow or no channels");
  const auto& [min_x, min_y, max_x, max_y] = *facts.window;
  constexpr std::int32_t kFarthest = 1 << 20;  // of the first pixel from the origin
  const std::int64_t width = std::int64_t{max_x} - min_x + 1, height = std::int64_t{max_y} - min_y + 1;
  if (width <= 0 || height <= 0 || width > std::numeric_limits<std::int32_t>::max() ||
      height > std::numeric_limits<std::int32_t>::max() || std::abs(std::int64_t{min_x}) > kFarthest ||
      std::abs(std::int64_t{min_y}) > kFarthest)
    fail(fmt::format("has the dataWindow {}, {} to {}, {}, which is no image", min_x, min_y, max_x, max_y));
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  require_within_limit(file, "header", bytes_of({pixels, facts.channels, sizeof(float)}), "pixels");
  const std::optional<std::uint64_t> packed = most_packed(facts.compression);
  if (packed && bytes_of({pixels, facts.pixel_bytes}) > bytes_of({content.size(), *packed}))
    fail(fmt::format("is truncated: {} × {} pixels of {} channels cannot be packed in {} bytes", width, height,
                     facts.channels, content.size()));
}

}  // namespace fathom
