// What an ideal sensor sees of a desk and of a cup without walls.
#pragma once

#include <cmath>

#include "core/cloud_file.h"
#include "core/units.h"

namespace fathom {

inline constexpr double kHeight = 0.650, kFocal = 570.342, kPitchDeg = 58.4;

/// A desk whose camera stands `height` above it, and in it a disc of the radius 40 mm at (37.5 mm, 300 mm) of the
/// camera's foot that rises to `disc` + `slope` · y: what an ideal sensor sees of a cup without walls.
inline Image<CloudPoint> ideal_cloud(double height, double disc, double slope = 0.0, float scale = 1.0f) {
  const double pitch = radians_from_deg(kPitchDeg);
  Image<CloudPoint> cloud(640, 480);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const double u = (x + 0.5 - 320.0) / kFocal, v = (y + 0.5 - 240.0) / kFocal;
      // Ahead and down per unit of depth.
      const double ahead = std::cos(pitch) - v * std::sin(pitch), down = std::sin(pitch) + v * std::cos(pitch);
      double z = height / down;
      const double in_disc = (height - disc + slope * 0.3) / (down + slope * ahead);
      if (std::hypot(in_disc * u - 0.0375, in_disc * ahead - 0.3) < 0.040) z = in_disc;
      cloud(x, y) = {scale * static_cast<float>(z * u), scale * static_cast<float>(z * v),
                     scale * static_cast<float>(z), 100.0f};
    }
  return cloud;
}

}  // namespace fathom
