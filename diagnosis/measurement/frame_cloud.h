// The cloud of one frame of a measurement, in metres.
#pragma once

#include "detector/cloud.h"
#include "diagnosis/measurement/frames.h"

namespace fathom {

/// Throws Error naming the file when it is no cloud, or none in metres.
Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder);

/// The same, naming the frame's row in the table besides.
Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder, const Table& table,
                       std::size_t row);

}  // namespace fathom
