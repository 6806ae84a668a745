#include "openni2/driver.h"

#include <OniCEnums.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "core/error.h"
#include "openni2/guard.h"

namespace fathom {
namespace {

constexpr int kLogError = 3;  ///< OpenNI2's severity

OniDeviceInfo device_info(const std::string& uri) {
  OniDeviceInfo info{};
  if (uri.size() >= sizeof info.uri) throw Error(uri, "is too long a path for OpenNI2, which takes 255 bytes");
  std::strcpy(info.uri, uri.c_str());
  std::strcpy(info.vendor, "Fathom");
  std::strcpy(info.name, "Virtual Xtion");
  return info;
}

}  // namespace

OniStatus Driver::initialize(oni::driver::DeviceConnectedCallback connected,
                             oni::driver::DeviceDisconnectedCallback disconnected,
                             oni::driver::DeviceStateChangedCallback state_changed, void* cookie) {
  return guarded(getServices(), ONI_STATUS_ERROR, [&] {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    const char* listed = std::getenv("FATHOM_DEVICES");
    std::istringstream uris(listed ? listed : "");
    for (std::string uri; std::getline(uris, uri, ':');)
      if (!uri.empty()) connect(uri);
    return ONI_STATUS_OK;
  });
}

OniStatus Driver::connect(const std::string& uri) {
  return guarded(getServices(), ONI_STATUS_ERROR, [&] {
    const OniDeviceInfo info = device_info(uri);
    deviceConnected(&info);
    return ONI_STATUS_OK;
  });
}

/// Only names are looked at: what is wrong with a scene is said when it is opened.
OniStatus Driver::tryDevice(const char* uri) { return names_source(uri) ? connect(uri) : ONI_STATUS_NO_DEVICE; }

oni::driver::DeviceBase* Driver::deviceOpen(const char* uri, const char*) {
  return guarded(getServices(), static_cast<oni::driver::DeviceBase*>(nullptr), [&]() -> oni::driver::DeviceBase* {
    const OniDeviceInfo info = device_info(uri);
    auto state_changed = [this, info](OniDeviceState state, const std::string& problem) {
      if (!problem.empty()) {
        getServices().log(kLogError, __FILE__, __LINE__, "Fathom", problem.c_str());
        getServices().errorLoggerAppend("%s", problem.c_str());
      }
      deviceStateChanged(&info, state);
    };
    auto device = std::make_unique<Device>(uri, getServices(), state_changed);
    const std::lock_guard lock(mutex_);
    return devices_.emplace_back(std::move(device)).get();
  });
}

void Driver::deviceClose(oni::driver::DeviceBase* device) {
  std::unique_ptr<Device> closed;  // after the lock: it waits for the frame in hand
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(devices_.begin(), devices_.end(), [&](const auto& each) { return each.get() == device; });
  if (found == devices_.end()) return;
  closed = std::move(*found);
  devices_.erase(found);
}

void Driver::shutdown() {
  const std::lock_guard lock(mutex_);
  devices_.clear();
}

/// All streams of a device show the same shot, so there is nothing to do for them; what OpenNI2 gets is only a sign.
void* Driver::enableFrameSync(oni::driver::StreamBase** streams, int count) {
  const auto player_of = [](oni::driver::StreamBase* stream) { return &static_cast<Stream*>(stream)->player(); };
  const bool one_device = std::all_of(streams, streams + count, [&](oni::driver::StreamBase* stream) {
    return player_of(stream) == player_of(streams[0]);
  });
  return one_device && count > 0 ? streams[0] : nullptr;
}

}  // namespace fathom

// What the header's macro takes from a library of OpenNI2's own that is not part of its packages.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

ONI_EXPORT_DRIVER(fathom::Driver)
