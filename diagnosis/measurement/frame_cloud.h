// The cloud of one frame of a measurement, in metres.
#pragma once

#include "core/image.h"
#include "detector/cloud.h"
#include "diagnosis/measurement/frames.h"

namespace fathom {

/// With the brightness of its infrared image, where the frame has one: of each of the cloud's pixels the mean over
/// those of the image, which has as many or a whole number of times as many columns, and its middle rows (Xtion and
/// Kinect: 1280 x 1024 about 640 x 480). Throws Error naming the file when it is no cloud, or none in metres; or when
/// the image is none, of another size, or the cloud has no rows.
Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder);

/// The same, naming the frame's row in the table besides.
Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder, const Table& table,
                       std::size_t row);

/// Counts [DN]: a 16-bit PNG, or an EXR of one channel. Throws Error naming the file when it is neither.
Image<float> read_infrared(const std::filesystem::path& file);

}  // namespace fathom
