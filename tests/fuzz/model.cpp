// Models of diagnoses: their effects are switched on in a scene with a cup of water.
#include "core/json.h"
#include "sim/effects/effects_json.h"
#include "sim/scene/setup.h"
#include "tests/fuzz/fuzz_file.h"

namespace {

fathom::Setup cup_of_water() {
  return fathom::setup_from_json(fathom::Json::parse(R"({
    "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]},
    "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}]})"),
                                 "scene");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fathom::Setup setup = cup_of_water();
  return fathom::fuzz_file(data, size, ".json",
                           [](const std::filesystem::path& path) { fathom::with_effects_of_model(setup, path); });
}
