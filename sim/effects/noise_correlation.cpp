#include <cmath>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_noise_correlation(Setup& setup, const EffectSetting& setting) {
  MatcherModel& matcher = setup.rig.sensor.matcher;
  const int more = 2 * static_cast<int>(std::lround(0.5 * setting.values[0]));
  matcher.window_columns += more;
  matcher.window_rows += more;
}

}  // namespace

Effect noise_correlation() {
  return {.id = "noise_correlation",
          .family = "sensor",
          .sentence = "Neighbouring pixels share the light of their blocks, so that their errors are alike.",
          .parameters = {{"wider_px", "added to the width of the blocks", 0.0, 8.0, 0.0, 22.0}},
          .citation = "PrimeSense's blocks of 9 x 9 pixels; errors of measured desks go together over 8 px along rows",
          .confounded = {"window_averaging"},
          .discriminated_by = "the correlation of what a bare desk leaves of its plane",
          .apply = apply_noise_correlation};
}

}  // namespace fathom::effects
