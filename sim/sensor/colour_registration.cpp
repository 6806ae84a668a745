#include "sim/sensor/colour_registration.h"

#include <cmath>

namespace fathom {

Image<float> registered_to_colour(const Image<float>& depth, double focal_px, double colour_focal_px) {
  Image<float> registered(depth.width(), depth.height());
  const double middle_x = 0.5 * depth.width(), middle_y = 0.5 * depth.height(), scale = colour_focal_px / focal_px;
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x) {
      const float z = depth(x, y);
      if (z <= 0.0f) continue;
      const double moved_px = colour_focal_px * kColourCamera / z;
      const int column = static_cast<int>(std::floor((x + 0.5 - middle_x) * scale - moved_px + middle_x));
      const int row = static_cast<int>(std::floor((y + 0.5 - middle_y) * scale + middle_y));
      if (column < 0 || row < 0 || column >= registered.width() || row >= registered.height()) continue;
      float& nearest = registered(column, row);
      if (nearest == 0.0f || z < nearest) nearest = z;
    }
  return registered;
}

}  // namespace fathom
