#include "diagnosis/measurement/frame_cloud.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/image_file.h"
#include "core/input_policy.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

void set_intensity(const Image<float>& infrared, const std::filesystem::path& file, Cloud& cloud) {
  if (cloud.height <= 1) throw Error(file.string(), "needs a cloud that keeps the camera's rows");
  const int scale = infrared.width() / cloud.width, first_row = (infrared.height() - scale * cloud.height) / 2;
  if (scale < 1 || scale * cloud.width != infrared.width() || scale * cloud.height > infrared.height())
    throw Error(file.string(),
                fmt::format("must be 1, 2, … times {} px wide and at least as many times {} px high, as its cloud is; "
                            "is {} x {}",
                            cloud.width, cloud.height, infrared.width(), infrared.height()));
  cloud.intensity.assign(cloud.points.size(), 0.0f);
  for (int y = 0; y < cloud.height; ++y)
    for (int x = 0; x < cloud.width; ++x) {
      double sum = 0.0;
      for (int v = 0; v < scale; ++v)
        for (int u = 0; u < scale; ++u) sum += infrared(scale * x + u, first_row + scale * y + v);
      cloud.intensity[static_cast<std::size_t>(y) * cloud.width + x] = static_cast<float>(sum / (scale * scale));
    }
}

Cloud cloud_of(const FrameRecord& frame, const std::filesystem::path& folder) {
  constexpr float kFarthestPoint = 50.0f;  // [m] no sensor of this kind sees farther than 10
  const std::filesystem::path file = path_named_in((folder / "frames.csv").string(), "column 'cloud'", frame.cloud);
  Cloud cloud = read_cloud(file);
  std::size_t measured = 0, far = 0;
  for (const Eigen::Vector3f& point : cloud.points) measured += point.allFinite(), far += point.z() > kFarthestPoint;
  if (2 * far > measured)
    throw Error(file.string(),
                fmt::format("must be in metres: most of its points lie more than {:g} away", kFarthestPoint));
  return cloud;
}

void add_infrared(const FrameRecord& frame, const std::filesystem::path& folder, Cloud& cloud) {
  if (frame.infrared.empty()) return;
  const std::filesystem::path file = path_named_in((folder / "frames.csv").string(), "column 'ir'", frame.infrared);
  set_intensity(read_infrared(file), file, cloud);
}

}  // namespace

Image<float> read_infrared(const std::filesystem::path& file) {
  if (file.extension() == ".exr") {
    std::vector<ExrChannel> channels = read_exr(file);
    if (channels.size() != 1)
      throw Error(file.string(), fmt::format("must have one channel as an infrared image, has {}", channels.size()));
    return std::move(channels.front().image);
  }
  const Image<std::uint16_t> counts = read_png_grey(file);
  Image<float> image(counts.width(), counts.height());
  std::copy(counts.pixels().begin(), counts.pixels().end(), image.pixels().begin());
  return image;
}

Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder) {
  Cloud cloud = cloud_of(frame, folder);
  add_infrared(frame, folder, cloud);
  return cloud;
}

Cloud read_frame_cloud(const FrameRecord& frame, const std::filesystem::path& folder, const Table& table,
                       std::size_t row) {
  std::string_view column = "cloud";
  try {
    Cloud cloud = cloud_of(frame, folder);
    column = "ir";
    add_infrared(frame, folder, cloud);
    return cloud;
  } catch (const Error& problem) {
    table.fail(row, column, problem.what());
  }
}

}  // namespace fathom
