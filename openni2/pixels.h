// A frame's images as the 16-bit pixels of an OpenNI2 stream.
#pragma once

#include <OniCTypes.h>

#include <cstdint>

#include "sim/sensor/capture.h"

namespace fathom {

/// Focal length of the colour camera's image that depths are registered to.
double colour_focal_px(const Setup& setup);

/// Depth in whole multiples of `unit` [m] on the device's law, if asked for as the colour camera sees it; 0 = nothing
/// measured.
Image<std::uint16_t> depth_pixels(const Setup& setup, const Frame& frame, double unit, bool registered);

/// The infrared image in DN, whole or, when `width` is the depth image's, at its size. 0 … infrared_full_scale().
Image<std::uint16_t> infrared_pixels(const SensorModel& sensor, const Frame& frame, int width);
int infrared_full_scale(const SensorModel& sensor);

/// Writes a part of the image row by row; `mirrored` turns left and right of the whole image before it is cut.
void copy_region(const Image<std::uint16_t>& image, const OniCropping& part, bool mirrored, std::uint16_t* to);

}  // namespace fathom
