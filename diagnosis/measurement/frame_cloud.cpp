#include "diagnosis/measurement/frame_cloud.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/input_policy.h"
#include "detector/read_cloud.h"

namespace fathom {

Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder) {
  constexpr float kFarthest = 50.0f;  // [m] no sensor of this kind sees farther than 10
  const std::filesystem::path file = path_named_in((folder / "frames.csv").string(), "column 'cloud'", frame.cloud);
  Cloud cloud = read_cloud(file);
  std::size_t measured = 0, far = 0;
  for (const Eigen::Vector3f& point : cloud.points) measured += point.allFinite(), far += point.z() > kFarthest;
  if (2 * far > measured)
    throw Error(file.string(), fmt::format("must be in metres: most of its points lie more than {:g} away", kFarthest));
  return cloud;
}

Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder, const Table& table,
                       std::size_t row) {
  try {
    return read_frame_cloud(frame, folder);
  } catch (const Error& problem) {
    table.fail(row, "cloud", problem.what());
  }
}

}  // namespace fathom
