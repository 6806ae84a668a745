// glTF files of strangers, text and binary.
#include "sim/scene/gltf.h"

#include <cstring>

#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool binary = size >= 4 && std::memcmp(data, "glTF", 4) == 0;
  return fathom::fuzz_file(data, size, binary ? ".glb" : ".gltf", fathom::read_gltf);
}
