// The memorised reference: what the infrared camera sees of a plane at the reference distance, prepared for matching.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/image.h"
#include "sim/scene/rig.h"
#include "sim/sensor/block_match.h"
#include "sim/sensor/pattern.h"

namespace fathom {

/// An image's even and odd columns, apart: a step of one depth pixel is a step of one value, so what is computed of
/// neighbouring pixels fills a vector. Rows of the infrared image are added in pairs: disparity lies along the rows, so
/// this halves the work and loses nothing but noise.
template <class T>
struct SplitColumns {
  Image<T> even, odd;
};

/// Columns that are read, but not used, beyond the right end of such an image: vectors are taken whole.
inline constexpr int kSlackColumns = 16;

/// Sub-pixel positions at which the reference is held, per depth pixel.
inline constexpr int kPhases = 8;

struct Reference {
  int margin_px = 0;                  ///< depth pixels by which the reference is wider than the image, on each side
  SplitColumns<std::int16_t> search;  ///< halved and locally normalised, (width + 2 margin) × (ir_height / 2)
  // Of the precise method only:
  std::array<Image<float>, kPhases> value;  ///< rows in pairs, at depth pixel x − margin + phase / kPhases
  std::array<Image<float>, kPhases> slope;  ///< its derivative along x [1/depth px]
  BlockReference blocks;                    ///< of the device's method only
};

/// The image of a plane at sensor.reference, facing the camera, of even brightness, displaced as this unit's is; wider
/// than the camera's image by `margin_px` depth pixels on each side, because a near surface shows dots that leave the
/// image at the reference.
Image<float> reference_image(const SensorModel& sensor, const Pattern& pattern, int margin_px, int samples_across);

/// Depth pixels of margin the matcher needs for its search range and window.
int reference_margin(const MatcherModel& matcher);

/// Prepares an image as reference_image() makes it (or a recorded one of the same size) for match().
Reference memorise(const SensorModel& sensor, const Image<float>& image, int margin_px);

/// The reference as the sensor remembers it: of the image above, taken with the speckle of its noise model, which is
/// the unit's own.
Reference remember(const SensorModel& sensor, const Pattern& pattern, int samples_across);

/// The same for cameras that follow one another: the last one is kept in the process, because making it takes longer
/// than most shots and sensors differ less often than scenes.
std::shared_ptr<const Reference> reference_image(const SensorModel& sensor, const Pattern& pattern, int samples_across);

/// Mean of each pair of rows: half the height.
Image<float> rows_in_pairs(const Image<float>& image);
/// Mean of each pair of columns: half the width.
Image<float> columns_in_pairs(const Image<float>& image);
/// Both halves of rows_in_pairs(), each kSlackColumns wider.
SplitColumns<float> split_rows_in_pairs(const Image<float>& image);
/// Mean of each even column and the odd one after it, of the first `width`.
Image<float> mean_of_columns(const SplitColumns<float>& split, int width);

}  // namespace fathom
