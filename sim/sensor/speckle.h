// Subjective speckle: what coherent light makes of a rough surface's even brightness on the detector.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sim/scene/rig.h"

namespace fathom {

/// Brightness of a still surface's speckle over its mean, one gain per infrared pixel; empty where no light is
/// coherent. The field's amplitude is complex Gaussian (fully developed, polarised) with the correlation that the
/// camera's lens leaves in it: |μ(r)|² = exp(−π r² / S), S = (4 / π) (λ F)² (Goodman, Speckle Phenomena in Optics,
/// 2007, ch. 4), sampled 3 × 3 times per pixel and integrated over it. Keyed by (seed, row of samples).
Image<float> speckle_field(const SensorModel& sensor, double coherent_share, int width, int height, std::uint64_t seed);

/// How many independent grains a pixel averages: one over the variance of wholly coherent light's gains.
double speckle_grains(const SensorModel& sensor);

/// The field of one frame: the static one, of which the share NoiseModel::speckle_renewed is drawn anew. Brightness
/// then wanders as the sum of squares of wandering amplitudes does: a step of the square-root process, whose
/// distribution is the Gamma that integrated speckle has. Keyed by (seed, frame, pixel).
Image<float> renewed_speckle(const SensorModel& sensor, const Image<float>& field, std::uint64_t seed,
                             std::uint64_t frame);

/// Multiplies an image by a field; by nothing where the field is empty.
void add_speckle(const Image<float>& field, Image<float>& image);

}  // namespace fathom
