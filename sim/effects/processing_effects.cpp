// Effects of how clouds and tables were made of what the sensor saw.
#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {

std::vector<Effect> processing_effects() {
  return {
      {.id = "window_averaging",
       .sentence = "A disparity is the mean over the matcher's window, not the pixel's own.",
       .parameters = {{"window_px", "width of the window", 1.0, 8.0, 1.0, 31.0}},
       .citation = "PrimeSense's window of 9 x 9 pixels; Scharstein & Szeliski 2002, IJCV 47, 7",
       .confounded = {"concave_bottom", "meniscus"},
       .discriminated_by = "a step of known height: windows round it off",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             setup.processing.window_px = std::max(setup.processing.window_px, setting.values[0]);
           }},
      {.id = "skew_approximation",
       .sentence = "Raised bottoms were reduced by the paper's closed form, not by exact triangulation.",
       .parameters = {{"share", "of the closed form, 1: all of it", 0.0, 1.0, 0.0, 1.0}},
       .citation = "Hara et al. 2014, Eq. 3 to 7: both rays at one incidence, the sensor's height for the point's",
       .confounded = {"refractive_index"},
       .discriminated_by = "clouds instead of tables of reduced heights",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             setup.processing.bisector = std::max(setup.processing.bisector, setting.values[0]);
           }},
      {.id = "colour_registration",
       .sentence =
           "Depths were moved to where the colour camera, 25 mm beside, has them, so that shadows lie on both sides.",
       .parameters = {{"registered", "1: they were, 0: not", 0.0, 1.0, 0.0, 1.0, {}, 1.0}},
       .citation = "OpenNI's depth-to-colour registration",
       .confounded = {"cup_placement", "principal_point"},
       .discriminated_by = "shadows of things on the desk: 75 mm of baseline on one side, or 50 and 25 mm on two",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             if (setting.values[0] >= 0.5) setup.processing.colour_view = true;
           }},
  };
}

}  // namespace fathom::effects
