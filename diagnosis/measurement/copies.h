// Frames that were not measured but copied: one cloud, or the same numbers, in two rows.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/frames.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// What tells whether two clouds are the same, or of a sensor without noise.
struct CloudPrint {
  std::uint64_t whole = 0;                ///< equal for equal clouds, in whatever file; 0 without points
  std::array<std::uint64_t, 12> parts{};  ///< of the image, depths alone; 0 with less than a hundred points
};

CloudPrint print_of(std::span<const SensedPoint> points, double focal_px);

struct Copies {
  std::vector<bool> left_out;     ///< of each frame, whether it does not count
  std::vector<Mistake> mistakes;  ///< "duplicated_trial"
};

/// Of a cloud that stands in several rows of one liquid, fill and place the first counts; of one that stands for two of
/// these, none: nobody knows which it was. Where all trials repeat the first of their placement, or all frames the
/// first of their condition, nothing is a copy if nothing scatters: if the desk around the cups is the same to the bit
/// in other clouds. `prints`: one of each frame. Of rows without clouds height, spread and points tell, within a
/// placement, where many more are alike than have all of another but the height or the points.
Copies find_copies(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints);

/// How many rows of a measurement repeat rows of an earlier one: clouds that are the same to the bit, unless nothing
/// scatters, and rows without clouds that agree in all but their session, frame and time, if three or more do.
std::size_t rows_repeated(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints,
                          const std::vector<FrameRecord>& earlier, std::span<const CloudPrint> earlier_prints);

}  // namespace fathom
