#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_cup_bottom_height(Setup& setup, const EffectSetting& setting) {
  const double more = metres_from_mm(setting.values[0]);
  for_each_cup(setup, [&](Cup&, CupShape& shape) {
    for (Eigen::Vector2d& point : shape.inner)
      if (&point != &shape.inner.back()) point.y() = std::clamp(point.y() + more, 0.0, shape.height());
  });
}

}  // namespace

Effect cup_bottom_height() {
  return {
      .id = "cup_bottom_height",
      .family = "cup",
      .sentence = "The inside of the cup's bottom lies higher above the desk than was measured.",
      .more = "the inside of the cup's bottom lies {} higher than was measured",
      .less = "the inside of the cup's bottom lies {} lower than was measured",
      .parameters = {{"height_mm", "added to the bottom's height; the liquid keeps its depth", 0.0, 0.5, -7.0, 30.0}},
      .citation = "Hara et al. 2014 do not give the cup's bottom; 7 mm is assumed",
      .confounded = {"fill_offset", "sensor_height"},
      .discriminated_by = "the empty cup: a fill cannot move its bottom",
      .apply = apply_cup_bottom_height};
}

}  // namespace fathom::effects
