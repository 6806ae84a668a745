// How much a run is going to write, said before the first frame.
#pragma once

#include <string>

#include "app/command.h"
#include "sim/scene/rig.h"

namespace fathom {

struct OutputSize {
  double frames;  ///< as a real number: what files ask for may be more than an integer holds
  double bytes_per_frame;

  double bytes() const;  ///< in whole blocks of a file system
};

/// What the files of one frame take at most: of a campaign, which writes a cloud and perhaps the infrared image, and of
/// a capture.
double frame_bytes(const SensorModel& sensor, bool infrared);
double capture_bytes(const SensorModel& sensor, bool infrared, bool device_outputs);

/// How many frames there will be, what they take and what the disk has: a sentence for announce(). Makes nothing. What
/// stands in the folder already counts as written. Throws UsageError above 20 GB without `yes`, Error where the disk
/// has not the space or frames cannot be numbered.
std::string require_space(const CommonOptions& common, const OutputSize& size, bool yes);

/// Says the sentence on stderr, but not with --quiet.
void announce(const CommonOptions& common, const std::string& sentence);

}  // namespace fathom
