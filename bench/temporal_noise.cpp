#include "bench/temporal_noise.h"

#include <algorithm>
#include <cmath>

#include "bench/sensor_scenes.h"
#include "core/median.h"
#include "core/units.h"

namespace fathom {

TemporalNoise temporal_noise(Camera& camera) {
  constexpr int kFrames = 16, kBorder = 4;
  std::vector<Image<float>> depths;
  double valid = 0.0;
  for (int frame = 0; frame < kFrames; ++frame) {
    depths.push_back(camera.shoot(static_cast<std::uint64_t>(frame)).depth);
    valid += valid_share(depths.back(), kBorder) / kFrames;
  }
  std::vector<double> deviations;
  double total = 0.0;
  for (std::size_t i = 0; i < depths[0].size(); ++i) {
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (const Image<float>& depth : depths) {
      const double z_mm = mm_from_metres(depth.pixels()[i]);
      sum += z_mm, squares += z_mm * z_mm, count += z_mm > 0.0;
    }
    if (count < 0.5 * kFrames) continue;
    deviations.push_back(std::sqrt(std::max(squares - sum * sum / count, 0.0) / (count - 1.0)));
    total += deviations.back();
  }
  if (deviations.empty()) return {0.0, 0.0, valid};
  const double mean = total / static_cast<double>(deviations.size());
  return {median(std::move(deviations)), mean, valid};
}

}  // namespace fathom
