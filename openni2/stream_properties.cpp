#include "openni2/stream_properties.h"

#include <OniCProperties.h>
#include <PS1080.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/units.h"
#include "openni2/pixels.h"
#include "sim/sensor/depth.h"

namespace fathom {
namespace {

// The device's depth law in OpenNI2's words: "shifts", which are the codes of sim/sensor/depth.h from another origin.
//
// OpenNI2 takes a shift s to a depth by x = (s − PARAM_COEFF · CONST_SHIFT) / PARAM_COEFF − 0.375, the disparity from
// the reference plane in pixels of the 1280-wide imager, m = x · ZPPS and Z = SHIFT_SCALE · ZPD · LDDIS / (LDDIS − m),
// cut to whole units (XnShiftToDepth.cpp of OpenNI2's PS1080 driver). That is device_depth() of the code s −
// kShiftOfCodeZero.
constexpr int kConstShift = 200;
constexpr int kParamCoeff = 4;
constexpr int kShiftScale = 10;  ///< mm in the centimetres of ZPD, ZPPS and LDDIS
constexpr int kMaxShift = kNoShift;
static_assert(kShiftOfCodeZero == kParamCoeff * kConstShift + 2);

/// Depth in whole multiples of `unit` [m] for every shift 0 … kMaxShift; 0 where there is none between near and far.
std::vector<std::uint16_t> shift_to_depth(const SensorModel& sensor, double unit) {
  Image<float> depth(kMaxShift + 1, 1);
  for (int shift = 0; shift < kMaxShift; ++shift) {
    const auto metres = device_depth(sensor, shift - kShiftOfCodeZero, cut_of(sensor, unit));
    if (metres && *metres >= sensor.law.near && *metres <= sensor.law.far)
      depth(shift, 0) = static_cast<float>(*metres);
  }
  const Image<std::uint16_t> whole = depth_in_units(depth, unit);
  return {whole.pixels().begin(), whole.pixels().end()};
}

/// The farthest shift whose depth is at most that, for every depth 0 … `max_depth` of the other table; 0 below its
/// least.
std::vector<std::uint16_t> depth_to_shift(const std::vector<std::uint16_t>& shift_to_depth, int max_depth) {
  std::vector<std::uint16_t> shifts;
  std::uint16_t farthest = 0;
  std::size_t shift = 0;
  for (int depth = 0; depth <= max_depth; ++depth) {
    for (; shift < shift_to_depth.size() && shift_to_depth[shift] <= depth; ++shift)
      if (shift_to_depth[shift] > 0) farthest = static_cast<std::uint16_t>(shift);
    shifts.push_back(farthest);
  }
  return shifts;
}

constexpr double kCentimetre = 0.01;

using Value = std::optional<PropertyValue>;

/// As clients make points with: what the device believes of itself, or of the colour camera.
double announced_focal_px(const FrameSource& source, const StreamState& state) {
  const bool of_colour = state.type == ONI_SENSOR_DEPTH && state.registered && source.setup().processing.colour_view;
  return of_colour ? colour_focal_px(source.setup()) : source.sensor().calibration().focal_px;
}

double field_of_view(int pixels, double focal_px) { return 2.0 * std::atan(0.5 * pixels / focal_px); }

int max_depth(const SensorModel& sensor, double unit) {
  return static_cast<int>(std::min(std::floor(sensor.law.far / unit), 65535.0));
}

std::int64_t max_value(const FrameSource& source, const StreamState& state) {
  if (state.type != ONI_SENSOR_DEPTH) return infrared_full_scale(source.sensor());
  return state.mode.pixelFormat == ONI_PIXEL_FORMAT_SHIFT_9_2 ? kMaxShift
                                                              : max_depth(source.sensor(), state.depth_unit());
}

int columns(const StreamState& state) { return state.cropping.enabled ? state.cropping.width : state.mode.resolutionX; }

PropertyValue table(const std::vector<std::uint16_t>& entries) { return bytes_of(entries.data(), entries.size()); }

/// A property that only depth streams have.
template <auto kValue>
Value of_depth(const FrameSource& source, const StreamState& state) {
  if (state.type != ONI_SENSOR_DEPTH) return std::nullopt;
  return kValue(source.sensor(), state);
}

template <std::int64_t kNumber>
PropertyValue constant(const SensorModel&, const StreamState&) {
  return kNumber;
}

PropertyValue zero_plane_distance(const SensorModel& sensor, const StreamState&) {
  return static_cast<std::int64_t>(std::llround(sensor.reference / kCentimetre));
}

/// Of the 1280 pixels that the imager has for the image's 640, on the reference plane.
PropertyValue zero_plane_pixel_size(const SensorModel& sensor, const StreamState&) {
  return sensor.reference / kCentimetre / (2.0 * sensor.calibration().focal_px);
}

PropertyValue emitter_to_camera(const SensorModel& sensor, const StreamState&) {
  return sensor.calibration().baseline / kCentimetre;
}

PropertyValue s2d(const SensorModel& sensor, const StreamState& state) {
  return table(shift_to_depth(sensor, state.depth_unit()));
}

PropertyValue d2s(const SensorModel& sensor, const StreamState& state) {
  const double unit = state.depth_unit();
  return table(depth_to_shift(shift_to_depth(sensor, unit), max_depth(sensor, unit)));
}

constexpr std::array kProperties{
    StreamProperty{ONI_STREAM_PROPERTY_VIDEO_MODE,
                   [](const FrameSource&, const StreamState& state) -> Value { return bytes_of(&state.mode, 1); }},
    StreamProperty{ONI_STREAM_PROPERTY_CROPPING,
                   [](const FrameSource&, const StreamState& state) -> Value { return bytes_of(&state.cropping, 1); }},
    StreamProperty{ONI_STREAM_PROPERTY_MIRRORING,
                   [](const FrameSource&, const StreamState& state) -> Value { return std::int64_t{state.mirrored}; }},
    StreamProperty{ONI_STREAM_PROPERTY_HORIZONTAL_FOV,
                   [](const FrameSource& source, const StreamState& state) -> Value {
                     return field_of_view(source.sensor().width, announced_focal_px(source, state));
                   }},
    StreamProperty{ONI_STREAM_PROPERTY_VERTICAL_FOV,
                   [](const FrameSource& source, const StreamState& state) -> Value {
                     const SensorModel& sensor = source.sensor();
                     const bool whole_imager = state.mode.resolutionX == sensor.ir_width;
                     const double focal_px = announced_focal_px(source, state);
                     return whole_imager ? field_of_view(sensor.ir_height, sensor.ir_scale() * focal_px)
                                         : field_of_view(sensor.height, focal_px);
                   }},
    StreamProperty{ONI_STREAM_PROPERTY_MIN_VALUE,
                   [](const FrameSource&, const StreamState&) -> Value { return std::int64_t{0}; }},
    StreamProperty{
        ONI_STREAM_PROPERTY_MAX_VALUE,
        [](const FrameSource& source, const StreamState& state) -> Value { return max_value(source, state); }},
    StreamProperty{ONI_STREAM_PROPERTY_STRIDE,
                   [](const FrameSource&, const StreamState& state) -> Value {
                     return static_cast<std::int64_t>(columns(state) * sizeof(std::uint16_t));
                   }},
    StreamProperty{ONI_STREAM_PROPERTY_NUMBER_OF_FRAMES,
                   [](const FrameSource& source, const StreamState&) -> Value {
                     return source.frames() ? Value(std::int64_t{*source.frames()}) : std::nullopt;
                   }},
    StreamProperty{XN_STREAM_PROPERTY_CONST_SHIFT, of_depth<constant<kConstShift>>},
    StreamProperty{XN_STREAM_PROPERTY_PIXEL_SIZE_FACTOR, of_depth<constant<1>>},
    StreamProperty{XN_STREAM_PROPERTY_MAX_SHIFT, of_depth<constant<kMaxShift>>},
    StreamProperty{XN_STREAM_PROPERTY_PARAM_COEFF, of_depth<constant<kParamCoeff>>},
    StreamProperty{XN_STREAM_PROPERTY_SHIFT_SCALE, of_depth<constant<kShiftScale>>},
    StreamProperty{XN_STREAM_PROPERTY_ZERO_PLANE_DISTANCE, of_depth<zero_plane_distance>},
    StreamProperty{XN_STREAM_PROPERTY_ZERO_PLANE_PIXEL_SIZE, of_depth<zero_plane_pixel_size>},
    StreamProperty{XN_STREAM_PROPERTY_EMITTER_DCMOS_DISTANCE, of_depth<emitter_to_camera>},
    StreamProperty{XN_STREAM_PROPERTY_S2D_TABLE, of_depth<s2d>},
    StreamProperty{XN_STREAM_PROPERTY_D2S_TABLE, of_depth<d2s>},
};

}  // namespace

double StreamState::depth_unit() const {
  return mode.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 0.1 * kMetresPerMm : kMetresPerMm;
}

std::span<const StreamProperty> stream_properties() { return kProperties; }

std::optional<PropertyValue> stream_property(const FrameSource& source, const StreamState& state, int id) {
  for (const StreamProperty& property : kProperties)
    if (property.id == id) return property.value(source, state);
  return std::nullopt;
}

}  // namespace fathom
