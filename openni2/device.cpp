#include "openni2/device.h"

#include <algorithm>
#include <cstring>

#include "openni2/guard.h"

namespace fathom {
namespace {

Bytes text(const std::string& words) { return bytes_of(words.c_str(), words.size() + 1); }

/// What OpenNI2 hands over for OniSeek: the client's stream is replaced by the driver's.
struct DriverSeek {
  int frame;
  oni::driver::StreamBase* stream;
};

}  // namespace

Device::Device(const std::string& uri, oni::driver::DriverServices& services, StateChanged state_changed)
    : uri_(uri), services_(services), player_(open_source(uri), [state_changed](const std::string& problem) {
        state_changed(problem.empty() ? ONI_DEVICE_STATE_EOF : ONI_DEVICE_STATE_ERROR, problem);
      }) {
  registered_ = player_.source().setup().processing.colour_view;
  const SensorModel& sensor = player_.source().sensor();
  for (const OniPixelFormat format :
       {ONI_PIXEL_FORMAT_DEPTH_1_MM, ONI_PIXEL_FORMAT_DEPTH_100_UM, ONI_PIXEL_FORMAT_SHIFT_9_2})
    depth_modes_.push_back({format, sensor.width, sensor.height, kFramesPerSecond});
  sensors_.push_back({ONI_SENSOR_DEPTH, static_cast<int>(depth_modes_.size()), depth_modes_.data()});
  if (!player_.source().has_infrared()) return;
  infrared_modes_ = {{ONI_PIXEL_FORMAT_GRAY16, sensor.width, sensor.height, kFramesPerSecond},
                     {ONI_PIXEL_FORMAT_GRAY16, sensor.ir_width, sensor.ir_height, kFramesPerSecond}};
  sensors_.push_back({ONI_SENSOR_IR, static_cast<int>(infrared_modes_.size()), infrared_modes_.data()});
}

OniStatus Device::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* Device::createStream(OniSensorType type) {
  return guarded(services_, static_cast<oni::driver::StreamBase*>(nullptr), [&]() -> oni::driver::StreamBase* {
    for (const OniSensorInfo& sensor : sensors_)
      if (sensor.sensorType == type) {
        const std::span modes(sensor.pSupportedVideoModes, static_cast<std::size_t>(sensor.numSupportedVideoModes));
        const std::lock_guard lock(mutex_);
        return streams_.emplace_back(std::make_unique<Stream>(type, modes, player_, registered_, services_)).get();
      }
    return nullptr;
  });
}

void Device::destroyStream(oni::driver::StreamBase* stream) {
  const std::lock_guard lock(mutex_);
  std::erase_if(streams_, [&](const auto& each) { return each.get() == stream; });
}

std::optional<PropertyValue> Device::property(int id) const {
  switch (id) {
    case ONI_DEVICE_PROPERTY_DRIVER_VERSION: {
      const OniVersion version{FATHOM_VERSION_MAJOR, FATHOM_VERSION_MINOR, FATHOM_VERSION_PATCH, 0};
      return bytes_of(&version, 1);
    }
    case ONI_DEVICE_PROPERTY_FIRMWARE_VERSION:
      return text("virtual " + player_.source().sensor().name);
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return text(uri_);
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return std::int64_t{registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF};
    case ONI_DEVICE_PROPERTY_PLAYBACK_SPEED:
      return is_folder() ? std::optional<PropertyValue>(double{player_.speed()}) : std::nullopt;
    case ONI_DEVICE_PROPERTY_PLAYBACK_REPEAT_ENABLED:
      return is_folder() ? std::optional<PropertyValue>(std::int64_t{player_.repeats()}) : std::nullopt;
    default:
      return std::nullopt;
  }
}

OniStatus Device::getProperty(int id, void* data, int* size) {
  return guarded(services_, ONI_STATUS_ERROR, [&] {
    const auto value = property(id);
    return value ? write_property(*value, data, size) : ONI_STATUS_NOT_SUPPORTED;
  });
}

OniBool Device::isPropertySupported(int id) {
  return guarded(services_, FALSE, [&] { return property(id) ? TRUE : FALSE; });
}

OniStatus Device::setProperty(int id, const void* data, int size) {
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
    const auto mode = read_property<OniImageRegistrationMode>(data, size);
    if (!mode) return ONI_STATUS_BAD_PARAMETER;
    if (!isImageRegistrationModeSupported(*mode)) return ONI_STATUS_NOT_SUPPORTED;
    registered_ = *mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    return ONI_STATUS_OK;
  }
  if (is_folder() && id == ONI_DEVICE_PROPERTY_PLAYBACK_SPEED) {
    const auto speed = read_property<float>(data, size);
    if (!speed || !(*speed >= Player::kFastest || *speed == Player::kManual)) return ONI_STATUS_BAD_PARAMETER;
    player_.set_speed(*speed);
    return ONI_STATUS_OK;
  }
  if (is_folder() && id == ONI_DEVICE_PROPERTY_PLAYBACK_REPEAT_ENABLED) {
    const auto repeats = read_property<OniBool>(data, size);
    if (!repeats) return ONI_STATUS_BAD_PARAMETER;
    player_.set_repeats(*repeats != FALSE);
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniBool Device::isCommandSupported(int command) { return command == ONI_DEVICE_COMMAND_SEEK && is_folder(); }

OniStatus Device::invoke(int command, void* data, int size) {
  if (!isCommandSupported(command)) return ONI_STATUS_NOT_SUPPORTED;
  const auto seek = read_property<DriverSeek>(data, size);
  if (!seek || seek->frame < 0 || seek->frame >= *player_.source().frames()) return ONI_STATUS_BAD_PARAMETER;
  player_.seek(seek->frame);
  return ONI_STATUS_OK;
}

OniStatus Device::tryManualTrigger() {
  if (player_.speed() == Player::kManual) player_.trigger();
  return ONI_STATUS_OK;
}

OniBool Device::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

}  // namespace fathom
