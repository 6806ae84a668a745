// Effects of liquids and of their surfaces.
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"
#include "sim/scene/cup.h"

namespace fathom::effects {
namespace {

/// Of liquids only fluorinated ones bend light less.
constexpr double kLeastIndex = 1.28;

}  // namespace

std::vector<Effect> liquid_effects() {
  return {
      {.id = "refractive_index",
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
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const double wavelength_nm = setup.rig.sensor.wavelength_nm;
             for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
               Medium& medium = filling.medium;
               if (setting.values[0] == 0.0) return;
               const double n = medium.n(wavelength_nm);
               medium.index = ConstantIndex{std::max(n + setting.values[0], std::min(n, kLeastIndex))};
             });
           },
       .of_liquids = true},
      {.id = "absorption",
       .sentence = "The liquid swallows more infrared light than its table says, or less.",
       .more = "the liquid's absorption coefficient is {} higher than its table says",
       .less = "the liquid's absorption coefficient is {} lower than its table says",
       .parameters = {{"absorption_per_mm", "added to the absorption coefficient, which stays at 0 or above", 0.0,
                       0.005, -0.05, 1.0}},
       .citation = "Kou, Labrie & Chylek 1993, Applied Optics 32, 3531: water's absorption in the near infrared",
       .confounded = {"wall_albedo"},
       .discriminated_by = "two fills of the same liquid: absorption grows with the path, an albedo does not",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
               filling.medium.absorption =
                   std::max(filling.medium.absorption + per_metre_from_per_mm(setting.values[0]), 0.0);
             });
           },
       .of_liquids = true},
      {.id = "subsurface_scattering",
       .sentence = "Light enters the liquid before it scatters back, so the surface reads too low.",
       .parameters = {{"transport_length_mm", "added to 1 / reduced scattering coefficient", 0.0, 1.0, 0.0, 20.0,
                       "scattering_per_mm"}},
       .citation = "Wang & Jacques 1995, Applied Optics 34, 2362: oblique-incidence reflectometry",
       .confounded = {"fill_offset"},
       .discriminated_by = "several distances: the shift goes with the cosine of the line of sight",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             if (setting.values[0] > 0.0)
               setup.light.interreflected = 1.0;  // direct light ends at a turbid liquid's surface
             for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
               Medium& medium = filling.medium;
               if (!medium.scatters()) return;
               const double length = 1.0 / medium.reduced_scattering() + metres_from_mm(setting.values[0]);
               medium.scattering = 1.0 / (length * (1.0 - medium.anisotropy));
             });
           },
       .of_liquids = true},
      stratification(),
  };
}

std::vector<Effect> surface_effects() {
  return {
      {.id = "meniscus",
       .sentence = "The liquid climbs the wall, or is pushed down there, so its surface is curved.",
       .parameters = {{"contact_angle_deg", "in the liquid, at the wall; 90: level", 90.0, 30.0, 10.0, 170.0}},
       .citation = "Landau & Lifshitz, Fluid Mechanics, section 61; capillary length of water 2.73 mm",
       .confounded = {"concave_bottom"},
       .discriminated_by = "ring regions against the centre, and an opaque liquid, whose surface is seen itself",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             if (setting.values[0] == 90.0) return;
             for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
               filling.form.wetting = Wetting{radians_from_deg(setting.values[0]), metres_from_mm(2.73)};
             });
           },
       .of_liquids = true},
      {.id = "surface_tilt",
       .sentence = "The liquid's surface is not parallel to the desk.",
       .parameters = {{"slope_x_deg", "rises to the sensor's right", 0.0, 0.3, -10.0, 10.0},
                      {"slope_y_deg", "rises away from the sensor", 0.0, 0.3, -10.0, 10.0}},
       .citation = "Hara et al. 2014 take the surface as level; a desk that leans by as much does the same",
       .confounded = {"sensor_roll", "sensor_pitch"},
       .discriminated_by = "the cup's sectors against each other; a spirit level on the desk",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const Eigen::Vector2d slope(std::tan(radians_from_deg(setting.values[0])),
                                         std::tan(radians_from_deg(setting.values[1])));
             for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
               LiquidForm& form = filling.form;
               const Eigen::Vector2d sum = std::tan(form.tilt) * direction_of(form.tilt_azimuth) + slope;
               form.tilt = std::atan(sum.norm());
               form.tilt_azimuth = std::atan2(sum.y(), sum.x());
             });
           },
       .of_liquids = true},
      {.id = "foam",
       .sentence = "Foam lies on the liquid and is what the sensor sees.",
       .more = "foam of {} lies on the liquid and is what the sensor sees",
       .parameters = {{"thickness_mm", "of the foam", 0.0, 1.0, 0.0, 20.0}},
       .citation =
           "Vera & Durian 1996, Physical Review E 53, 3215: foam scatters within a few bubbles, so it is opaque",
       .confounded = {"fill_offset", "evaporation"},
       .discriminated_by = "the same pour after the foam has gone",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             if (setting.values[0] == 0.0) return;
             for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
               const double room = cup_depth(cup) - filling.depth;
               filling.depth += std::min(metres_from_mm(setting.values[0]), room);
               filling.medium.scattering = per_metre_from_per_mm(1000.0);
               filling.medium.anisotropy = 0.0;
             });
           },
       .of_liquids = true},
      ripples(),
  };
}

}  // namespace fathom::effects
