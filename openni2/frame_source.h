// Where the frames of a virtual device come from: a scene that is shot live, or a captured folder that is played.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/sensor/capture.h"

namespace fathom {

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// What is shot, its effects switched on.
  virtual const Setup& setup() const = 0;
  virtual bool has_infrared() const = 0;
  /// How many frames there are to be played; nothing when every frame is new.
  virtual std::optional<int> frames() const = 0;

  /// What has to be done once before the first frame; may take seconds. Throws Error.
  virtual void prepare() {}
  /// Disparities and, where wanted, infrared image of the frame of that number, counted from 0. Throws Error.
  virtual Frame shoot(int frame, bool infrared) = 0;

  const SensorModel& sensor() const { return setup().rig.sensor; }
};

/// Whether a device's URI is meant for this driver: the name of a scene file, whether or not it exists, or a folder.
bool names_source(const std::string& uri);

/// Reads the scene file, or run.json of the folder, and of each frame as much as shows whether it is whole. Throws
/// Error.
std::unique_ptr<FrameSource> open_source(const std::string& uri);

}  // namespace fathom
