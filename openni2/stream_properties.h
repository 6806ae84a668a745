// What clients can ask of a stream: one table of OpenNI2's own properties and those of the PS1080, the Xtion's chip.
#pragma once

#include <OniCTypes.h>

#include <optional>
#include <span>

#include "openni2/frame_source.h"
#include "openni2/property_value.h"

namespace fathom {

/// A stream as it is set up.
struct StreamState {
  OniSensorType type;
  OniVideoMode mode;
  OniCropping cropping;  ///< the whole image when it is not enabled
  bool mirrored;
  bool registered;  ///< depth as the colour camera sees it, which is the device's setting

  double depth_unit() const;  ///< [m] of the mode's pixel format
};

struct StreamProperty {
  int id;
  /// Nothing when a stream of that type does not have it.
  std::optional<PropertyValue> (*value)(const FrameSource& source, const StreamState& state);
};

std::span<const StreamProperty> stream_properties();

/// Nothing when the stream does not have it.
std::optional<PropertyValue> stream_property(const FrameSource& source, const StreamState& state, int id);

}  // namespace fathom
