// The infrared image: radiance sampled over each pixel, then the detector's noise.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sim/render/light.h"
#include "sim/scene/rig.h"
#include "sim/sensor/pattern.h"

namespace fathom {

/// Which light an image is made of.
enum class LightModel {
  direct,     ///< from the projector to what the camera sees, refracted or not; bodies that scatter are opaque
  scattered,  ///< direct light, what bodies scatter, by few walks, and what these mirror of direct light
  full        ///< all: thrown from wall to wall, mirrored by liquids, scattered within bodies
};

/// Mean radiance of every infrared pixel [DN], ir_width × ir_height, without noise.
struct IrLight {
  Image<float> projected;  ///< of the projector's light
  Image<float> ambient;    ///< of NoiseModel::ambient_dn, even and from all sides, on what is seen; empty without it
};

/// Each pixel is sampled on a grid of `samples_across`² points; the dots are smooth, so a grid converges faster than
/// random points and adds no noise. Only other light is left to chance, keyed by (seed, row, pixel or sample).
IrLight render_ir(const PointLight& projector, const Rig& rig, const Pattern& pattern, int samples_across,
                  LightModel light, std::uint64_t seed);

/// Speckle of a static scene, dot by dot: one gain for each, Gamma(shape, mean/shape).
std::vector<float> speckle_gains(const NoiseModel& noise, const Pattern& pattern, std::uint64_t seed);

/// The detector's numbers for the light of one frame [DN at gain 1]: gain, blooming, shot and read noise, rounding and
/// saturation. Keyed by (seed, frame, pixel).
Image<float> expose(const Image<float>& light, const NoiseModel& noise, std::uint64_t seed, std::uint64_t frame);

/// The infrared image at the depth image's size: the mean of the four pixels that lie in each depth pixel.
Image<float> at_depth_scale(const SensorModel& sensor, const Image<float>& ir);

}  // namespace fathom
