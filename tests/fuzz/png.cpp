// PNG images of patterns.
#include "core/image_file.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fathom::fuzz_file(data, size, ".png", [](const std::filesystem::path& path) { fathom::read_png_grey(path); });
}
