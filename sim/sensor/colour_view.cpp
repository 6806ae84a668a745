#include "sim/sensor/colour_view.h"

#include <cmath>

namespace fathom {

Image<float> in_colour_view(const Image<float>& depth, double focal_px) {
  constexpr double kColourBaseline = 0.025;  // [m]
  Image<float> seen(depth.width(), depth.height());
  const double middle_x = 0.5 * depth.width(), middle_y = 0.5 * depth.height();
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x) {
      const float z = depth(x, y);
      if (z <= 0.0f) continue;
      const double right = (x + 0.5 - middle_x) / focal_px - kColourBaseline / z,
                   down = (y + 0.5 - middle_y) / focal_px;
      const int column = static_cast<int>(std::floor(right * kColourFocalPx + middle_x));
      const int row = static_cast<int>(std::floor(down * kColourFocalPx + middle_y));
      if (column < 0 || row < 0 || column >= seen.width() || row >= seen.height()) continue;
      float& nearest = seen(column, row);
      if (nearest == 0.0f || z < nearest) nearest = z;
    }
  return seen;
}

}  // namespace fathom
