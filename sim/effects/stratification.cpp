#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_stratification(Setup& setup, const EffectSetting& setting) {
  const double wavelength_nm = setup.rig.sensor.wavelength_nm;
  std::vector<Cup> layers;
  for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
    if (filling.medium.scatters() || setting.values[0] == 0.0) return;
    // A second cup in the same place, filled half as high, is the lower half: where bodies overlap the last wins.
    Cup layer = cup;
    layer.filling->medium.index = ConstantIndex{filling.medium.n(wavelength_nm) + setting.values[0]};
    layer.filling->depth *= 0.5;
    layer.filling->form = {};
    layers.push_back(std::move(layer));
  });
  for (Cup& layer : layers) setup.scene.cups.push_back(std::move(layer));
}

}  // namespace

Effect stratification() {
  return {.id = "stratification",
          .sentence = "The lower half of the liquid is denser, so it bends light more.",
          .more = "the refractive index of the liquid's lower half is {} higher than that of the upper",
          .parameters = {{"index_step", "added to the refractive index of the lower half, on which the other floats",
                          0.0, 0.01, 0.0, 0.3}},
          .citation = "Born & Wolf, Principles of Optics, section 3.2: rays in stratified media",
          .confounded = {"refractive_index"},
          .discriminated_by = "the same pour before and after stirring",
          .apply = apply_stratification,
          .of_liquids = true};
}

}  // namespace fathom::effects
