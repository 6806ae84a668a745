// Campaign specs.
#include "campaign/campaign_spec.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fathom::fuzz_file(data, size, ".json", fathom::read_campaign_spec);
}
