// Measurement directories of strangers: rig.json, frames.csv and a cloud.
#include "diagnosis/measurement/read_measurement.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fathom::fuzz_folder(data, size, {"rig.json", "frames.csv", "cloud.pcd"},
                             [](const std::filesystem::path& folder) { fathom::read_measurement(folder); });
}
