// A stream of depth or infrared images.
#pragma once

#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <mutex>
#include <span>

#include "openni2/player.h"
#include "openni2/stream_properties.h"

namespace fathom {

class Stream final : public oni::driver::StreamBase {
 public:
  /// The first mode is the one it starts with. All arguments must outlive it.
  Stream(OniSensorType type, std::span<const OniVideoMode> modes, Player& player, const std::atomic<bool>& registered,
         oni::driver::DriverServices& services);
  ~Stream() override { stop(); }

  const Player& player() const { return player_; }

  OniStatus start() override;
  void stop() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  void notifyAllProperties() override;

 private:
  StreamState state() const;
  OniStatus set_mode(const OniVideoMode& mode);
  OniStatus set_cropping(const OniCropping& cropping);
  void deliver(const Shot& shot);

  std::span<const OniVideoMode> modes_;
  Player& player_;
  const std::atomic<bool>& registered_;  ///< the device's setting
  oni::driver::DriverServices& services_;

  mutable std::mutex mutex_;  ///< of what follows; never held while OpenNI2 is called, which asks back
  StreamState state_;
  bool started_ = false;
};

}  // namespace fathom
