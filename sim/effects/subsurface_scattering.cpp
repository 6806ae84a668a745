#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_subsurface_scattering(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] > 0.0) setup.light.interreflected = 1.0;  // direct light ends at a turbid liquid's surface
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    Medium& medium = filling.medium;
    if (!medium.scatters()) return;
    const double length = 1.0 / medium.reduced_scattering() + metres_from_mm(setting.values[0]);
    medium.scattering = 1.0 / (length * (1.0 - medium.anisotropy));
  });
}

}  // namespace

Effect subsurface_scattering() {
  return {.id = "subsurface_scattering",
          .family = "liquid",
          .sentence = "Light enters the liquid before it scatters back, so the surface reads too low.",
          .parameters = {{"transport_length_mm", "added to 1 / reduced scattering coefficient", 0.0, 1.0, 0.0, 20.0,
                          "scattering_per_mm"}},
          .citation = "Wang & Jacques 1995, Applied Optics 34, 2362: oblique-incidence reflectometry",
          .confounded = {"fill_offset"},
          .discriminated_by = "several distances: the shift goes with the cosine of the line of sight",
          .apply = apply_subsurface_scattering,
          .of_liquids = true};
}

}  // namespace fathom::effects
