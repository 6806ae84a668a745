#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_concave_bottom(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] == 0.0) return;
  constexpr int kRings = 16;
  const double depth = metres_from_mm(setting.values[0]);
  for_each_cup(setup, [&](Cup& cup, CupShape& shape) {
    const auto pieces = static_cast<int>(shape.bottom_points()) - 1;
    if (pieces < 1) return;  // the walls meet in a point
    const double edge = shape.inner[pieces].x();
    const int rings = std::max(kRings / pieces, 1);
    std::vector<Eigen::Vector2d> bowl;
    for (int piece = 0; piece < pieces; ++piece)
      for (int ring = 0; ring < rings + (piece + 1 == pieces); ++ring) {
        const Eigen::Vector2d &from = shape.inner[piece], &to = shape.inner[piece + 1];
        bowl.emplace_back(from + static_cast<double>(ring) / rings * (to - from));
        const double share = bowl.back().x() / edge;
        bowl.back().y() -= depth * (1.0 - share * share);
      }
    shape.inner.erase(shape.inner.begin(), shape.inner.begin() + pieces + 1);
    shape.inner.insert(shape.inner.begin(), bowl.begin(), bowl.end());
    if (cup.filling) cup.filling->depth = std::max(cup.filling->depth + depth, 0.0);  // a ruler stands at the wall
  });
}

}  // namespace

Effect concave_bottom() {
  return {.id = "concave_bottom",
          .sentence = "The inside of the cup's bottom is a bowl.",
          .more = "the middle of the cup's bottom lies {} below its edge",
          .less = "the middle of the cup's bottom lies {} above its edge",
          .parameters = {{"depth_mm", "by which the bottom's middle lies below its edge", 0.0, 0.5, -5.0, 5.0}},
          .citation = "Hara et al. 2014 take the bottom as flat; pressed cups are not",
          .confounded = {"meniscus"},
          .discriminated_by = "the empty cup by regions, and turned by a quarter",
          .apply = apply_concave_bottom};
}

}  // namespace fathom::effects
