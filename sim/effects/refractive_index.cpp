#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

/// Of liquids only fluorinated ones bend light less.
constexpr double kLeastIndex = 1.28;

void apply_refractive_index(Setup& setup, const EffectSetting& setting) {
  const double wavelength_nm = setup.rig.sensor.wavelength_nm;
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    Medium& medium = filling.medium;
    if (setting.values[0] == 0.0) return;
    const double n = medium.n(wavelength_nm);
    medium.index = ConstantIndex{std::max(n + setting.values[0], std::min(n, kLeastIndex))};
  });
}

}  // namespace

Effect refractive_index() {
  return {
      .id = "refractive_index",
      .family = "liquid",
      .sentence = "The liquid bends light more than its table says.",
      .more = "the liquid's refractive index is {} higher than its table says",
      .less = "the liquid's refractive index is {} lower than its table says",
      .parameters = {{"index_change",
                      "added to the refractive index at the sensor's wavelength, down to an index of 1.28", 0.0, 0.005,
                      -0.3, 0.3}},
      .citation =
          "Daimon & Masumura 2007, Applied Optics 46, 3811: water at 830 nm has 1.328, not the 1.333 of visible light",
      .confounded = {"fill_scale", "fill_offset"},
      .discriminated_by = "several distances and fills of the same liquid: the index acts on depth times obliqueness",
      .apply = apply_refractive_index,
      .of_liquids = true};
}

}  // namespace fathom::effects
