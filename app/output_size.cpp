#include "app/output_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "app/print.h"
#include "core/error.h"
#include "core/input_policy.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr double kMostUnasked = 20e9;  // [bytes]

constexpr double kBlock = 4096.0;  ///< [bytes] of a file system: files take whole ones

double in_blocks(double bytes) { return std::ceil(bytes / kBlock) * kBlock; }

/// What an earlier run may have left. Frames stand in the folder or one below it; what lies deeper does not count.
double bytes_of_frames(const fs::path& folder) {
  double bytes = 0.0;
  std::error_code unreadable;
  for (fs::recursive_directory_iterator entry(folder, unreadable), end; entry != end; entry.increment(unreadable)) {
    if (entry.depth() > 0) entry.disable_recursion_pending();
    if (entry->is_regular_file(unreadable)) bytes += in_blocks(static_cast<double>(entry->file_size(unreadable)));
  }
  return bytes;
}

/// Of the disk on which the folder is or will be.
double free_bytes(fs::path folder) {
  folder = fs::absolute(folder).lexically_normal();
  while (!fs::exists(folder) && folder.has_relative_path()) folder = folder.parent_path();
  return static_cast<double>(fs::space(folder).available);
}

double pixels(int width, int height) { return static_cast<double>(width) * height; }

}  // namespace

double frame_bytes(const SensorModel& sensor, bool infrared) {
  constexpr double kHeader = 256.0, kPoint = 16.0, kDn = 2.0;
  return kHeader + kPoint * pixels(sensor.width, sensor.height) +
         (infrared ? kDn * pixels(sensor.ir_width, sensor.ir_height) : 0.0);
}

double capture_bytes(const SensorModel& sensor, bool infrared, bool device_outputs) {
  // Of images that are compressed: what those of noisy frames without steps of depth take.
  constexpr double kDepths = 10.0, kInfrared = 2.5, kDevice = 1.0;
  return frame_bytes(sensor, false) +
         (kDepths + (device_outputs ? kDevice : 0.0)) * pixels(sensor.width, sensor.height) +
         (infrared ? kInfrared * pixels(sensor.ir_width, sensor.ir_height) : 0.0);
}

double OutputSize::bytes() const { return frames * in_blocks(bytes_per_frame); }

std::string require_space(const CommonOptions& common, const OutputSize& size, bool yes) {
  const double missing = std::max(0.0, size.bytes() - bytes_of_frames(common.output));
  const double free = free_bytes(common.output);
  const std::string what =
      fmt::format("{:.0f} frames are up to {}, of which {} are still to be written; the disk has {} free", size.frames,
                  size_text(size.bytes()), size_text(missing), size_text(free));
  if (missing > kMostUnasked && !yes)
    throw UsageError(fmt::format("{}; more than {} are written only with --yes", what, size_text(kMostUnasked)));
  if (missing > free) throw Error(common.output.string(), what + ": choose a larger disk or fewer frames");
  if (size.frames > std::numeric_limits<int>::max())
    throw Error(common.output.string(), fmt::format("{:.0f} frames are too many, at most {} can be numbered",
                                                    size.frames, std::numeric_limits<int>::max()));
  return what;
}

void announce(const CommonOptions& common, const std::string& sentence) {
  if (!common.quiet) print_status(fmt::format("{}: {}", common.output.string(), sentence));
}

}  // namespace fathom
