// The memorised reference: what the infrared camera sees of a plane at the reference distance, prepared for matching.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "sim/scene/rig.h"
#include "sim/sensor/pattern.h"

namespace fathom {

/// Sub-pixel positions at which the reference is held, per infrared pixel.
inline constexpr int kPhases = 4;
/// Side of the refinement's window in infrared pixels: 8 depth pixels, two vectors of 8 floats.
inline constexpr int kRefineWindow = 16;

/// Sums over one refinement window of the reference r and its horizontal derivative g [1/px].
struct WindowMoments {
  float r, g, rr, rg, gg;
  float centre_x, centre_y;  ///< centroid of g² from the window's first pixel's centre [infrared px]
};

struct Reference {
  int margin_px = 0;  ///< depth pixels by which the reference is wider than the image, on each side
  Image<std::int16_t> search;  ///< halved and locally normalised, (width + 2 margin) × (ir_height / 2)
  std::vector<Image<float>> shifted;   ///< [phase] reference at x + phase / kPhases, infrared pixels
  std::vector<Image<float>> gradient;  ///< [phase] its derivative along x
  /// By window row (one per depth row), first column and phase.
  std::vector<WindowMoments> moments;
  int moment_columns = 0;

  const WindowMoments& moments_at(int depth_row, int first_column, int phase) const {
    return moments[(static_cast<std::size_t>(depth_row) * moment_columns + first_column) * kPhases + phase];
  }
};

/// The ideal image of a plane at sensor.reference, facing the camera, of even brightness; wider than the camera's image
/// by `margin_px` depth pixels on each side, because a near surface shows dots that leave the image at the reference.
Image<float> reference_image(const SensorModel& sensor, const Pattern& pattern, int margin_px, int samples_across);

/// Depth pixels of margin the matcher needs for its search range and window.
int reference_margin(const MatcherModel& matcher);

/// Prepares an image as reference_image() makes it (or a recorded one of the same size) for match().
Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px);

/// Mean of 2×2 blocks.
Image<float> halved(const Image<float>& image);

/// Deviation from the mean of the matcher's window over its standard deviation (at least `contrast_min`), scaled so that
/// a window's sum of products fits 16 bits.
Image<std::int16_t> locally_normalised(const Image<float>& image, const MatcherModel& matcher);

/// Row of the infrared image at which the refinement window of a depth row starts.
inline int window_first_row(const SensorModel& sensor, int depth_row) {
  return sensor.ir_first_row() + 2 * depth_row + 1 - kRefineWindow / 2;
}

}  // namespace fathom
