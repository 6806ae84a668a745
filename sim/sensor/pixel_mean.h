// The mean of a smooth function over one pixel.
#pragma once

namespace fathom {

/// Mean of sample(dx, dy) over a grid of `samples_across`² points, dx and dy in 0 … 1 from the pixel's upper left
/// corner.
template <class Sample>
double pixel_mean(int samples_across, Sample sample) {
  double sum = 0.0;
  for (int j = 0; j < samples_across; ++j)
    for (int i = 0; i < samples_across; ++i) sum += sample((i + 0.5) / samples_across, (j + 0.5) / samples_across);
  return sum / (samples_across * samples_across);
}

}  // namespace fathom
