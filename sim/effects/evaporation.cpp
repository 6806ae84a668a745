#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_evaporation(Setup& setup, const EffectSetting& setting) {
  constexpr double kSecondsPerHour = 3600.0;
  const double fallen = metres_from_mm(setting.values[0]) * setup.circumstances.stood_s / kSecondsPerHour;
  for_each_filling(setup, setting,
                   [&](Cup&, Filling& filling) { filling.depth = std::max(filling.depth - fallen, 0.0); });
}

}  // namespace

Effect evaporation() {
  return {.id = "evaporation",
          .family = "book-keeping",
          .sentence = "The liquid's level falls from the moment it is poured.",
          .more = "the liquid's level falls by {} from the moment it is poured",
          .parameters = {{"rate_mm_per_h", "by which the level falls", 0.0, 1.0, 0.0, 50.0}},
          .citation = "Sartori 2000, Solar Energy 68, 77: tenths of a millimetre an hour from water at rest",
          .confounded = {"thermal_drift", "fill_offset"},
          .discriminated_by = "the same pour when it is fresh and after it has stood",
          .apply = apply_evaporation,
          .of_liquids = true,
          .of_time = true};
}

}  // namespace fathom::effects
