// A virtual sensor: its streams, and what plays for all of them.
#pragma once

#include <Driver/OniDriverAPI.h>

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "openni2/player.h"
#include "openni2/stream.h"

namespace fathom {

class Device final : public oni::driver::DeviceBase {
 public:
  /// Called when no more frames will come, on another thread: ONI_DEVICE_STATE_EOF, or ONI_DEVICE_STATE_ERROR with the
  /// error's line.
  using StateChanged = std::function<void(OniDeviceState state, const std::string& problem)>;

  /// Reads what the URI names. Throws Error. `services` must outlive it.
  Device(const std::string& uri, oni::driver::DriverServices& services, StateChanged state_changed);

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType type) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  OniStatus invoke(int command, void* data, int size) override;
  OniBool isCommandSupported(int command) override;
  OniStatus tryManualTrigger() override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 private:
  std::optional<PropertyValue> property(int id) const;
  bool is_folder() const { return player_.source().frames().has_value(); }

  std::string uri_;
  oni::driver::DriverServices& services_;
  Player player_;
  std::vector<OniVideoMode> depth_modes_, infrared_modes_;
  std::vector<OniSensorInfo> sensors_;
  std::atomic<bool> registered_ = false;  ///< depth as the colour camera sees it
  std::mutex mutex_;
  std::vector<std::unique_ptr<Stream>> streams_;  ///< those that are not destroyed are when the device is closed
};

}  // namespace fathom
