#include "report/depth_picture.h"

#include <algorithm>
#include <cmath>

namespace fathom {

Image<Rgb> depth_picture(const Image<float>& depth_m) {
  float near = HUGE_VALF, far = 0.0f;
  for (const float metres : depth_m.pixels())
    if (metres > 0.0f) near = std::min(near, metres), far = std::max(far, metres);
  Image<Rgb> picture(depth_m.width(), depth_m.height(), Rgb{0, 0, 0});
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (const float metres = depth_m.pixels()[i]; metres > 0.0f)
      picture.pixels()[i].fill(static_cast<std::uint8_t>(60.0 + 180.0 * (far - metres) / std::max(far - near, 1e-3f)));
  return picture;
}

}  // namespace fathom
