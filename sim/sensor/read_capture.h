// What `fathom capture` wrote, read back.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/sensor/capture.h"

namespace fathom {

struct RecordedCapture {
  Setup setup;                                ///< what was shot, its effects switched on
  bool infrared;                              ///< photometric mode, so that its frames have infrared images
  std::vector<std::filesystem::path> frames;  ///< the folder of each, at least one

  const SensorModel& sensor() const { return setup.rig.sensor; }
};

/// Reads run.json, which need not lie where it was written. Throws Error when the folder holds no complete capture.
RecordedCapture read_capture(const std::filesystem::path& folder);

/// Throws Error naming the first frame's file that is missing, no image of the sensor's size, or cut short. Reads
/// little of each.
void check_frames(const RecordedCapture& capture);

/// One frame's disparities and, where wanted, infrared image as they were written; the rest is left empty. Throws Error
/// naming the file that is missing, damaged or of another size than the sensor's images.
Frame read_frame(const RecordedCapture& capture, std::size_t index, bool infrared);

}  // namespace fathom
