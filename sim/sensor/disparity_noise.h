// The noise of a geometric capture: statistics instead of images. What sensor/match gets out of speckle and dots is
// here drawn at random, with the deviations and correlations that measured desks show (NoiseModel::disparity).
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sim/scene/rig.h"

namespace fathom {

/// What chance makes of the light in the block about every pixel: white noise n on the pixels, added up over the
/// matcher's window. Each image has variance 1; neighbours share what their blocks share.
struct BlockChance {
  Image<float> level;         ///< Σ n: too much or too little light
  Image<float> across, down;  ///< Σ x n, Σ y n: where in the block it is, to the right and down
};

/// Keyed by (seed, key, row).
BlockChance block_chance(const SensorModel& sensor, std::uint64_t seed, std::uint64_t key);

/// Standard deviation over a block of the dots' light on a surface at `depth` [m] where a dot's centre has `intensity`
/// [DN]: what the matcher's least contrast is compared with.
double block_contrast(const SensorModel& sensor, double intensity, double depth);

/// What the device's blocks would make of exact disparities [px, 0 = invalid], before its law of 1/8 px: each reads the
/// surface where its light happens to lie, a little off the pixel, so that slopes and edges become uneven, and is off
/// by a deviation that grows as dots blur and as they drown in the detector's noise. Nothing where the contrast is too
/// small, nor within half a block of the image's sides. `still` stays the same for all frames of a scene, `renewed` is
/// of one frame; `intensity` [DN] is that of a dot's centre.
Image<float> disparity_with_noise(const SensorModel& sensor, const Image<float>& exact_px,
                                  const Image<float>& intensity, const BlockChance& still, const BlockChance& renewed);

}  // namespace fathom
