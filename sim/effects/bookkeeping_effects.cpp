// Effects of filling and of what was written down.
#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"
#include "sim/scene/cup.h"

namespace fathom::effects {

std::vector<Effect> bookkeeping_effects() {
  return {
      {.id = "fill_offset",
       .sentence = "Every pour holds more than was written down, by as much each time.",
       .more = "every pour holds {} more than was written down",
       .less = "every pour holds {} less than was written down",
       .parameters = {{"fill_mm", "added to every fill", 0.0, 0.5, -50.0, 50.0}},
       .citation = "Hara et al. 2014 pour to marks of 10, 20 and 30 mm",
       .confounded = {"cup_bottom_height", "foam", "subsurface_scattering"},
       .discriminated_by = "weighing the cup, or an empty cup beside it",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
               filling.depth = std::clamp(filling.depth + metres_from_mm(setting.values[0]), 0.0, cup_depth(cup));
             });
           },
       .of_liquids = true},
      {.id = "fill_scale",
       .sentence = "Every pour holds more than was written down, in proportion.",
       .more = "every pour is {} larger than was written down",
       .less = "every pour is {} smaller than was written down",
       .in_percent = true,
       .parameters = {{"scale", "fills are 1 plus this times what was written", 0.0, 0.03, -0.9, 2.0}},
       .citation = "Hara et al. 2014 pour to marks of 10, 20 and 30 mm",
       .confounded = {"refractive_index", "unit_error"},
       .discriminated_by = "weighing the cup at two fills",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
               filling.depth = std::clamp(filling.depth * (1.0 + setting.values[0]), 0.0, cup_depth(cup));
             });
           },
       .of_liquids = true},
      {.id = "evaporation",
       .sentence = "The liquid's level falls from the moment it is poured.",
       .more = "the liquid's level falls by {} from the moment it is poured",
       .parameters = {{"rate_mm_per_h", "by which the level falls", 0.0, 1.0, 0.0, 50.0}},
       .citation = "Sartori 2000, Solar Energy 68, 77: tenths of a millimetre an hour from water at rest",
       .confounded = {"thermal_drift", "fill_offset"},
       .discriminated_by = "the same pour when it is fresh and after it has stood",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             constexpr double kSecondsPerHour = 3600.0;
             const double fallen = metres_from_mm(setting.values[0]) * setup.circumstances.stood_s / kSecondsPerHour;
             for_each_filling(setup, setting,
                              [&](Cup&, Filling& filling) { filling.depth = std::max(filling.depth - fallen, 0.0); });
           },
       .of_liquids = true,
       .of_time = true},
      {.id = "label_swap",
       .sentence = "The labels of the first two liquids are swapped.",
       .parameters = {{"swapped", "1: swapped, 0: right", 0.0, 1.0, 0.0, 1.0}},
       .citation =
           "camera-calibration practice: a missing effect is often a mistake in the protocol (Kalibr, issues 561 "
           "and 722)",
       .confounded = {"subsurface_scattering", "refractive_index"},
       .discriminated_by = "looking into the cups",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const std::vector<Medium>& liquids = setup.circumstances.liquids;
             if (setting.values[0] < 0.5 || liquids.size() < 2) return;
             for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
               if (filling.medium.name == liquids[0].name)
                 filling.medium = liquids[1];
               else if (filling.medium.name == liquids[1].name)
                 filling.medium = liquids[0];
             });
           }},
      {.id = "unit_error",
       .sentence = "Fills were written down in another unit than millimetres.",
       .parameters = {{"factor", "millimetres in what was taken for one: inch 25.4, centimetre 10", 1.0, 0.5, 0.03,
                       30.0}},
       .citation =
           "camera-calibration practice: a missing effect is often a mistake in the protocol (Kalibr, issues 561 "
           "and 722)",
       .confounded = {"fill_scale"},
       .discriminated_by = "reading the marks again",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
               filling.depth = std::min(filling.depth * setting.values[0], cup_depth(cup));
             });
           },
       .of_liquids = true},
      {.id = "wrong_cup",
       .sentence = "Another cup stands there, of the same form in another size.",
       .parameters = {{"scale", "the cup's lengths are 1 plus this times those of the right one", 0.0, 0.1, -0.5, 1.0}},
       .citation =
           "camera-calibration practice: a missing effect is often a mistake in the protocol (Kalibr, issues 561 and "
           "722)",
       .confounded = {"cup_bottom_height"},
       .discriminated_by = "a ruler",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for_each_cup(setup, [&](Cup&, CupShape& shape) {
               for (Eigen::Vector2d& point : shape.inner) point *= 1.0 + setting.values[0];
               for (Eigen::Vector2d& point : shape.outer) point *= 1.0 + setting.values[0];
             });
           }},
  };
}

}  // namespace fathom::effects
