// Disparity to depth, as the device's table does it, and depth to a cloud.
#pragma once

#include <cstdint>
#include <optional>

#include "core/cloud_file.h"
#include "core/image.h"
#include "core/units.h"
#include "sim/scene/rig.h"

namespace fathom {

/// The device's depth law: z = floor(1 / (1/z_ref − (n + ½) p / 36000)) in mm (½: DepthLaw::step_phase) with p =
/// 0.1052 for the Xtion PRO LIVE; in terms of the rig, p / 36000 mm⁻¹ = 1 / (8 f b), a step of 1/8 px of disparity.
/// Verified on recorded depth without a fitted parameter (OpenNI's shift-to-depth table). `code` n is any integer,
/// growing with distance. [m], nothing where the law has no positive depth. `unit` [m] is what depths are cut to, 0:
/// nothing; the device has outputs of 1 and 0.1 mm.
std::optional<double> device_depth(const SensorModel& sensor, int code, double unit = kMetresPerMm);

/// What depths are cut to [m] in an output of the unit `unit` [m]: to as many units as to millimetres in the sensor's
/// own.
double cut_of(const SensorModel& sensor, double unit);

/// The code whose exact depth (before truncation to whole mm) is nearest in disparity to `depth` [m]; of those that
/// come together the middle one, or of an even number the farther of the two there.
int device_code(const SensorModel& sensor, double depth);

/// f b / Z [px] at the depth image's scale, of what is really there.
double disparity_of_depth(const SensorModel& sensor, double depth);

/// f b / d [m], with what the device takes for f and b.
double depth_of_disparity(const SensorModel& sensor, double disparity_px);

/// Depth image [m], 0 = invalid, from disparities relative to infinity [px], 0 = invalid: on the device's law or, when
/// the sensor is not quantized, as it is. Depths outside near … far are invalid.
Image<float> depth_image(const SensorModel& sensor, const Image<float>& disparity_px, double unit = kMetresPerMm);

/// Depth [m] as whole multiples of `unit` [m], rounded; 0 = invalid, as is what 16 bits cannot hold.
Image<std::uint16_t> depth_in_units(const Image<float>& depth, double unit);

/// Organised cloud in the camera frame; NaN where the depth is invalid. `intensity` [DN] has the depth image's size.
Image<CloudPoint> cloud_of_depth(const SensorModel& sensor, const Image<float>& depth, const Image<float>& intensity);

}  // namespace fathom
