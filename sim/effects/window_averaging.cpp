#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_window_averaging(Setup& setup, const EffectSetting& setting) {
  setup.processing.window_px = std::max(setup.processing.window_px, setting.values[0]);
}

}  // namespace

Effect window_averaging() {
  return {.id = "window_averaging",
          .family = "processing",
          .sentence = "A disparity is the mean over the matcher's window, not the pixel's own.",
          .parameters = {{"window_px", "width of the window", 1.0, 8.0, 1.0, 31.0}},
          .citation = "PrimeSense's window of 9 x 9 pixels; Scharstein & Szeliski 2002, IJCV 47, 7",
          .confounded = {"concave_bottom", "meniscus"},
          .discriminated_by = "a step of known height: windows round it off",
          .apply = apply_window_averaging};
}

}  // namespace fathom::effects
