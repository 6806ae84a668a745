#include "detector/read_cloud.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "detector/read_pcd.h"
#include "detector/read_ply.h"

namespace fathom {

Cloud read_cloud(const std::filesystem::path& path) {
  const std::string content = read_text(path), file = path.string();
  const std::string_view start = std::string_view(content).substr(0, 8);
  const auto starts = [&](std::string_view word) { return start.starts_with(word); };
  if (content.empty()) throw Error(file, "is empty, expected a PCD or PLY cloud");
  const bool ply = starts("ply\n") || starts("ply\r\n");
  if (!ply && !starts("#") && !starts("VERSION") && !starts("FIELDS")) throw Error(file, "is neither PCD nor PLY");
  Cloud cloud = ply ? read_ply(file, content) : read_pcd(file, content);
  take_as_measured(cloud);
  return cloud;
}

std::string doubt_of_units(const Cloud& cloud) {
  constexpr float kFar_m = 50.0f;  // beyond what such a camera measures; in millimetres it would be too near
  std::ptrdiff_t far = 0, near = 0;
  for (const Eigen::Vector3f& point : cloud.points) {
    far += point.z() > kFar_m;
    near += point.z() <= kFar_m;
  }
  if (far <= near) return {};
  return fmt::format("most points lie more than {:g} m away; clouds are in metres, is this one in millimetres?",
                     kFar_m);
}

}  // namespace fathom
