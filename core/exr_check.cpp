#include "core/exr_check.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/error.h"

namespace fathom {

void check_exr(const std::filesystem::path& path, int width, int height) try {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const std::int64_t wide = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t high = std::int64_t{window.max.y} - window.min.y + 1;
  if (wide != width || high != height)
    throw Error(path.string(), fmt::format("is {} × {} pixels, expected {} × {}", wide, high, width, height));
  std::vector<float> line(static_cast<std::size_t>(width));
  Imf::FrameBuffer frame;
  if (const auto channel = file.header().channels().begin(); channel != file.header().channels().end())
    frame.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(line.data() - window.min.x),
                                            sizeof(float), 0));  // the same line for every y
  file.setFrameBuffer(frame);
  file.readPixels(window.max.y);
} catch (const Error&) {
  throw;
} catch (const std::exception& problem) {
  throw Error(path.string(), std::string("cannot read as OpenEXR: ") + problem.what());
}

}  // namespace fathom
