#include <cmath>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_surface_tilt(Setup& setup, const EffectSetting& setting) {
  const Eigen::Vector2d slope(std::tan(radians_from_deg(setting.values[0])),
                              std::tan(radians_from_deg(setting.values[1])));
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    LiquidForm& form = filling.form;
    const Eigen::Vector2d sum = std::tan(form.tilt) * direction_of(form.tilt_azimuth) + slope;
    form.tilt = std::atan(sum.norm());
    form.tilt_azimuth = std::atan2(sum.y(), sum.x());
  });
}

}  // namespace

Effect surface_tilt() {
  return {.id = "surface_tilt",
          .family = "surface",
          .sentence = "The liquid's surface is not parallel to the desk.",
          .parameters = {{"slope_x_deg", "rises to the sensor's right", 0.0, 0.3, -10.0, 10.0},
                         {"slope_y_deg", "rises away from the sensor", 0.0, 0.3, -10.0, 10.0}},
          .citation = "Hara et al. 2014 take the surface as level; a desk that leans by as much does the same",
          .confounded = {"sensor_roll", "sensor_pitch"},
          .discriminated_by = "the cup's sectors against each other; a spirit level on the desk",
          .apply = apply_surface_tilt,
          .of_liquids = true};
}

}  // namespace fathom::effects
