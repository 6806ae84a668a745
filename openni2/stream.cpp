#include "openni2/stream.h"

#include <algorithm>
#include <type_traits>

#include "openni2/guard.h"
#include "openni2/pixels.h"
#include "sim/sensor/depth.h"

namespace fathom {
namespace {

OniCropping whole_image(const OniVideoMode& mode) { return {FALSE, 0, 0, mode.resolutionX, mode.resolutionY}; }

bool same(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY &&
         a.fps == b.fps;
}

bool inside(const OniCropping& part, const OniVideoMode& mode) {
  return part.originX >= 0 && part.originY >= 0 && part.width > 0 && part.height > 0 &&
         part.originX <= mode.resolutionX - part.width && part.originY <= mode.resolutionY - part.height;
}

/// Shifts stay where the infrared camera has them: the device registers what its table made of them.
Image<std::uint16_t> measured_pixels(const Setup& setup, const Frame& frame, const StreamState& state) {
  if (state.mode.pixelFormat == ONI_PIXEL_FORMAT_SHIFT_9_2) return shift_image(setup.rig.sensor, frame.disparity_px);
  return depth_pixels(setup, frame, state.depth_unit(), state.registered);
}

}  // namespace

Stream::Stream(OniSensorType type, std::span<const OniVideoMode> modes, Player& player,
               const std::atomic<bool>& registered, oni::driver::DriverServices& services)
    : modes_(modes),
      player_(player),
      registered_(registered),
      services_(services),
      state_{type, modes.front(), whole_image(modes.front()), false, false} {}

StreamState Stream::state() const {
  const std::lock_guard lock(mutex_);
  StreamState now = state_;
  now.registered = registered_;
  return now;
}

OniStatus Stream::start() {
  return guarded(services_, ONI_STATUS_ERROR, [&] {
    player_.add(this, state().type == ONI_SENSOR_IR, [this](const Shot& shot) { deliver(shot); });
    const std::lock_guard lock(mutex_);
    started_ = true;
    return ONI_STATUS_OK;
  });
}

void Stream::stop() {
  player_.remove(this);
  const std::lock_guard lock(mutex_);
  started_ = false;
}

/// OpenNI2 knows no way to end a client's wait for a frame that will not come. Who asks for anything is told why.
OniStatus Stream::getProperty(int id, void* data, int* size) {
  return guarded(services_, ONI_STATUS_ERROR, [&] {
    player_.require_sound();
    const auto value = stream_property(player_.source(), state(), id);
    return value ? write_property(*value, data, size) : ONI_STATUS_NOT_SUPPORTED;
  });
}

OniBool Stream::isPropertySupported(int id) {
  return guarded(services_, FALSE, [&] { return stream_property(player_.source(), state(), id) ? TRUE : FALSE; });
}

OniStatus Stream::setProperty(int id, const void* data, int size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE: {
      const auto mode = read_property<OniVideoMode>(data, size);
      return mode ? set_mode(*mode) : ONI_STATUS_BAD_PARAMETER;
    }
    case ONI_STREAM_PROPERTY_CROPPING: {
      const auto cropping = read_property<OniCropping>(data, size);
      return cropping ? set_cropping(*cropping) : ONI_STATUS_BAD_PARAMETER;
    }
    case ONI_STREAM_PROPERTY_MIRRORING: {
      const auto mirrored = read_property<OniBool>(data, size);
      if (!mirrored) return ONI_STATUS_BAD_PARAMETER;
      const std::lock_guard lock(mutex_);
      state_.mirrored = *mirrored != FALSE;
      return ONI_STATUS_OK;
    }
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

/// The size of frames is settled when a stream starts.
OniStatus Stream::set_mode(const OniVideoMode& mode) {
  if (std::none_of(modes_.begin(), modes_.end(), [&](const OniVideoMode& each) { return same(each, mode); })) {
    services_.errorLoggerAppend("%s", "the virtual Xtion does not have this video mode");
    return ONI_STATUS_NOT_SUPPORTED;
  }
  const std::lock_guard lock(mutex_);
  if (started_ && !same(mode, state_.mode)) {
    services_.errorLoggerAppend("%s", "a stream's video mode cannot change while it runs: stop it first");
    return ONI_STATUS_OUT_OF_FLOW;
  }
  state_.mode = mode;
  state_.cropping = whole_image(mode);
  return ONI_STATUS_OK;
}

OniStatus Stream::set_cropping(const OniCropping& cropping) {
  const std::lock_guard lock(mutex_);
  if (cropping.enabled && !inside(cropping, state_.mode)) return ONI_STATUS_BAD_PARAMETER;
  state_.cropping = cropping.enabled ? cropping : whole_image(state_.mode);
  return ONI_STATUS_OK;
}

void Stream::notifyAllProperties() {
  guarded(services_, ONI_STATUS_ERROR, [&] {
    const StreamState now = state();
    for (const StreamProperty& property : stream_properties()) {
      const auto value = property.value(player_.source(), now);
      if (!value) continue;
      std::visit(
          [&](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, Bytes>)
              raisePropertyChanged(property.id, held.data(), static_cast<int>(held.size()));
            else
              raisePropertyChanged(property.id, &held, sizeof held);
          },
          *value);
    }
    return ONI_STATUS_OK;
  });
}

void Stream::deliver(const Shot& shot) {
  const StreamState now = state();
  if (now.type == ONI_SENSOR_IR && shot.frame.ir.empty()) return;  // taken before this stream was started
  const Setup& setup = player_.source().setup();
  const Image<std::uint16_t> image = now.type == ONI_SENSOR_DEPTH
                                         ? measured_pixels(setup, shot.frame, now)
                                         : infrared_pixels(setup.rig.sensor, shot.frame, now.mode.resolutionX);
  OniFrame* frame = getServices().acquireFrame();
  if (!frame) return;
  copy_region(image, now.cropping, now.mirrored, static_cast<std::uint16_t*>(frame->data));
  frame->sensorType = now.type;
  frame->timestamp = shot.time_us;
  frame->frameIndex = shot.number;
  frame->videoMode = now.mode;
  frame->width = now.cropping.width;
  frame->height = now.cropping.height;
  frame->croppingEnabled = now.cropping.enabled;
  frame->cropOriginX = now.cropping.originX;
  frame->cropOriginY = now.cropping.originY;
  frame->stride = static_cast<int>(now.cropping.width * sizeof(std::uint16_t));
  frame->dataSize = frame->stride * frame->height;
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

}  // namespace fathom
