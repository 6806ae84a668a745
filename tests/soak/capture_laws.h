// What holds of every capture, whatever was captured.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/rig.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// One sentence for every law that the frame or the camera that shot it breaks: images of the sensor's size without a
/// number that is not finite (but for the places of invalid points), no negative radiance, depths in range, and images
/// that agree with each other about what is valid. Where nothing can focus light, no pixel is brighter than white that
/// faces the projector at the nearest surface.
std::vector<std::string> broken_capture_laws(const Rig& rig, const Camera& camera, LightModel light,
                                             const Frame& frame);

}  // namespace fathom
