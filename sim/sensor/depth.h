// What follows from a disparity: what one device reads, depth as the device's table has it, what it sends, a cloud.
#pragma once

#include <Eigen/Core>
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

/// Disparity relative to infinity [px] of a point at `depth` [m] that is seen at `pixel_px`. A distorted image is
/// compared with one of the reference plane that is distorted alike: only what changes between the two places counts.
double seen_disparity(const SensorModel& sensor, const Eigen::Vector2d& pixel_px, double depth);

/// What the unit makes of a disparity relative to infinity [px]. It measures from the reference plane, whose distance
/// it knows: a wrong focal length or baseline does no harm there.
double read_disparity(const SensorModel& sensor, const UnitError& error, double disparity_px);

/// Depth image [m], 0 = invalid, from disparities relative to infinity [px], 0 = invalid: on the device's law or, when
/// the sensor is not quantized, as it is. Depths outside near … far are invalid.
Image<float> depth_image(const SensorModel& sensor, const Image<float>& disparity_px, double unit = kMetresPerMm);

/// Depth [m] as whole multiples of `unit` [m], rounded; 0 = invalid, as is what 16 bits cannot hold.
Image<std::uint16_t> depth_in_units(const Image<float>& depth, double unit);

/// The raw shift of the code 0: OpenNI's table takes a shift s to x = (s − 4 · 200) / 4 − 0.375 = (code + ½) / 4.
inline constexpr int kShiftOfCodeZero = 4 * 200 + 2;
inline constexpr int kNoShift = 2047;  ///< nothing measured; also the first that 11 bits cannot hold

/// What the device can send instead of depths (docs/files.md): raw shifts 0 … 2046 of disparities relative to infinity
/// [px]; kNoShift where depth_image() has no depth.
Image<std::uint16_t> shift_image(const SensorModel& sensor, const Image<float>& disparity_px);

// Depth registered to the colour camera: what most recorded clouds of these sensors are.

/// The colour camera stands beside the infrared camera, towards the projector, with the same axes.
inline constexpr double kColourCamera = 0.025;  ///< [m]

/// Of the colour camera, as drivers that make clouds take it; OpenNI2 takes the depth image's.
inline constexpr double kColourFocalPx = 525.0;

/// Each depth [m] of an image of focal length `focal_px` moves to where a colour camera of `colour_focal_px` and the
/// same size sees its point; the nearest wins, and what no point meets is a hole, 0. Depths stay as they are, as the
/// device leaves them.
Image<float> registered_to_colour(const Image<float>& depth, double focal_px, double colour_focal_px);

/// Organised cloud in the camera frame; NaN where the depth is invalid. `intensity` [DN] has the depth image's size.
Image<CloudPoint> cloud_of_depth(const SensorModel& sensor, const Image<float>& depth, const Image<float>& intensity);

}  // namespace fathom
