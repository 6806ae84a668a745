// What holds of every capture, whatever was captured.
#pragma once

#include <string>
#include <vector>

#include "sim/sensor/capture.h"

namespace fathom {

/// One sentence for every law that the frame or the camera that shot it breaks: images of the sensor's size without a
/// number that is not finite (but for the places of invalid points), no negative radiance, depths in range, and images
/// that agree with each other about what is valid.
std::vector<std::string> broken_capture_laws(const SensorModel& sensor, const Camera& camera, const Frame& frame);

}  // namespace fathom
