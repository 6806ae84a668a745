// The driver as OpenNI2 loads it: which devices there are, and opening them.
#pragma once

#include <Driver/OniDriverAPI.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "openni2/device.h"

namespace fathom {

/// A device's URI is the path of a scene file or of a captured folder. Those that the environment variable
/// FATHOM_DEVICES lists, separated by colons, are there from the start; any other appears when it is opened.
class Driver final : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override;
  OniStatus tryDevice(const char* uri) override;
  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* mode) override;
  void deviceClose(oni::driver::DeviceBase* device) override;
  void shutdown() override;
  void* enableFrameSync(oni::driver::StreamBase** streams, int count) override;

 private:
  OniStatus connect(const std::string& uri);

  std::mutex mutex_;
  std::vector<std::unique_ptr<Device>> devices_;  ///< the open ones
};

}  // namespace fathom
