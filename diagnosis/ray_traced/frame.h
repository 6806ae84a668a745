// What a frame of a set-up says, by the whole simulated camera: infrared image, matcher, depth, cloud.
#pragma once

#include <cstdint>

#include "diagnosis/measurement/frame_estimates.h"
#include "sim/scene/setup.h"

namespace fathom {

/// What the laboratory would find in such clouds: one scene shot twice, both clouds' points together, under the
/// measurement's own estimators. The light is that of a measurement (measured_light), the unit one without wander.
/// Equal seeds give equal noise, so that set-ups that differ a little differ in nothing else. Nothing when no desk is
/// seen.
std::optional<FrameEstimates> ray_traced_frame(const Setup& setup, const LaboratoryRig& rig, const FrameView& view,
                                               std::uint64_t seed);

}  // namespace fathom
