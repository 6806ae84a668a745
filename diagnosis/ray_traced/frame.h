// The cloud of a set-up by the whole simulated camera: infrared image, matcher, depth.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/measurement/frame_estimates.h"
#include "sim/scene/setup.h"

namespace fathom {

/// The points of two shots of one scene, each half a pixel of its cloud. The light is that of a measurement
/// (measured_light), the unit one without wander. Equal seeds give equal noise, so that set-ups that differ a little
/// differ in nothing else.
std::vector<SensedPoint> ray_traced_points(const Setup& setup, std::uint64_t seed);

}  // namespace fathom
