// The memorised reference: what the infrared camera sees of a plane at the reference distance, prepared for matching.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "sim/scene/rig.h"
#include "sim/sensor/block_match.h"
#include "sim/sensor/pattern.h"

namespace fathom {

/// Sub-pixel positions at which the reference is held, per infrared pixel.
inline constexpr int kPhases = 4;

/// The refinement's window: 8 × 7 depth pixels.
inline constexpr int kRefineColumns = 16;  ///< infrared pixels
inline constexpr int kRefineRows = 7;      ///< row pairs

/// Rows of the infrared image are added in pairs before refinement: disparity lies along the rows, so this halves the
/// work and loses nothing but noise.
struct Reference {
  int margin_px = 0;                   ///< depth pixels by which the reference is wider than the image, on each side
  Image<std::int16_t> search;          ///< halved and locally normalised, (width + 2 margin) × (ir_height / 2)
  std::vector<Image<float>> shifted;   ///< [phase] rows in pairs, at x + phase / kPhases infrared pixels
  std::vector<Image<float>> gradient;  ///< [phase] its derivative along x [1/infrared px]
  BlockReference blocks;               ///< of the device's method only
};

/// The ideal image of a plane at sensor.reference, facing the camera, of even brightness; wider than the camera's image
/// by `margin_px` depth pixels on each side, because a near surface shows dots that leave the image at the reference.
Image<float> reference_image(const SensorModel& sensor, const Pattern& pattern, int margin_px, int samples_across);

/// First row pair of the refinement's window of a depth row; windows stay inside the infrared image.
int refine_first_row(const SensorModel& sensor, int depth_row);

/// Depth pixels of margin the matcher needs for its search range and window.
int reference_margin(const MatcherModel& matcher);

/// Prepares an image as reference_image() makes it (or a recorded one of the same size) for match().
Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px);

/// The reference as the sensor remembers it: of the image above, taken with the speckle of its noise model, which is
/// the unit's own.
Reference remember(const SensorModel& sensor, const Pattern& pattern, int samples_across);

/// Mean of each pair of rows: half the height.
Image<float> rows_in_pairs(const Image<float>& image);
/// Mean of each pair of columns: half the width.
Image<float> columns_in_pairs(const Image<float>& image);

/// Deviation from the mean of the matcher's window over its standard deviation (at least `contrast_min`), scaled so
/// that a window's sum of products fits 16 bits.
Image<std::int16_t> locally_normalised(const Image<float>& image, const MatcherModel& matcher);

}  // namespace fathom
