// What the device does to find a disparity: a block of the image at the depth image's scale is compared with blocks of
// the reference image, in steps of 1/8 px, and the most alike stands for the whole block. Neither the slope of a
// surface nor an edge in the block is allowed for: dots of a block that lie on a slope pull its disparity by their lot.
#pragma once

#include <span>
#include <vector>

#include "core/image.h"
#include "sim/scene/rig.h"

namespace fathom {

/// An image at the depth image's scale, with what a block's correlation needs: each block's sum and the root of its
/// squares about the mean, by the block's upper left pixel.
struct Blocks {
  Image<float> values, sum, spread;
};

/// The reference image at shifts of 1/8 px.
struct BlockReference {
  std::vector<Blocks> phase;  ///< [eighth] the image at x + eighth / 8, as many as kPhases
};

/// From the phases of Reference::value.
BlockReference block_reference(const MatcherModel& matcher, std::span<const Image<float>> phases);

/// Disparity of every pixel relative to the reference plane [px], a multiple of 1/8; NaN where the block is not whole,
/// has too little contrast, or nothing is alike enough. `halved` is the infrared image at the depth
/// image's scale, `coarse` what search() found in it.
Image<float> block_match(const SensorModel& sensor, Image<float> halved, const BlockReference& reference, int margin_px,
                         const Image<float>& coarse);

}  // namespace fathom
