// Effects of the cup.
#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {

std::vector<Effect> cup_effects() {
  return {
      {.id = "cup_bottom_height",
       .sentence = "The inside of the cup's bottom lies higher above the desk than was measured.",
       .more = "the inside of the cup's bottom lies {} higher than was measured",
       .less = "the inside of the cup's bottom lies {} lower than was measured",
       .parameters = {{"height_mm", "added to the bottom's height; the liquid keeps its depth", 0.0, 0.5, -7.0, 30.0}},
       .citation = "Hara et al. 2014 do not give the cup's bottom; 7 mm is assumed",
       .confounded = {"fill_offset", "sensor_height"},
       .discriminated_by = "the empty cup: a fill cannot move its bottom",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const double more = metres_from_mm(setting.values[0]);
             for_each_cup(setup, [&](Cup&, CupShape& shape) {
               for (Eigen::Vector2d& point : shape.inner)
                 if (&point != &shape.inner.back()) point.y() = std::clamp(point.y() + more, 0.0, shape.height());
             });
           }},
      concave_bottom(),
      {.id = "wall_albedo",
       .sentence = "The cup reflects more infrared light than its model.",
       .more = "the cup's albedo is {} higher than the model's",
       .less = "the cup's albedo is {} lower than the model's",
       .parameters = {{"albedo", "added to the cup's albedo", 0.0, 0.1, -0.7, 0.3}},
       .citation = "Hara et al. 2014 do not give the cup's colour; 0.70 is assumed",
       .confounded = {"absorption", "wall_multipath"},
       .discriminated_by = "the empty cup's brightness beside the desk's",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for_each_cup(setup, [&](Cup&, CupShape& shape) {
               shape.albedo = std::clamp(shape.albedo + setting.values[0], 0.0, 1.0);
             });
           }},
      {.id = "cup_placement",
       .sentence = "The cup stands beside the place that was written down, always by as much.",
       .parameters = {{"x_mm", "to the sensor's right", 0.0, 2.0, -30.0, 30.0},
                      {"y_mm", "away from the sensor", 0.0, 2.0, -30.0, 30.0}},
       .citation = "Hara et al. 2014 place cups by hand at marks on the desk",
       .confounded = {"sensor_pitch", "sensor_roll"},
       .discriminated_by = "the cup's outline in the cloud",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for (Cup& cup : setup.scene.cups)
               cup.position += Eigen::Vector2d(metres_from_mm(setting.values[0]), metres_from_mm(setting.values[1]));
           }},
  };
}

}  // namespace fathom::effects
