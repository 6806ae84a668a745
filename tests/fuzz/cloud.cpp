// PCD and PLY clouds of strangers.
#include "detector/read_cloud.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fathom::fuzz_file(data, size, ".cloud", fathom::read_cloud);
}
