#include "bench/measured_desks.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace fathom {
namespace {

constexpr DeskPrior kMounted{0.60, 0.61};  ///< as all nine scenes, by eye

}  // namespace

Eigen::Vector3d point_in_colour(const Image<float>& depth, int x, int y) {
  return depth(x, y) * Eigen::Vector3d((x + 0.5 - 0.5 * depth.width()) / kColourFocalPx,
                                       (y + 0.5 - 0.5 * depth.height()) / kColourFocalPx, 1.0);
}

std::optional<DeskImage> with_desk(std::string name, Image<float> depth) {
  constexpr int kStep = 3;  // every third row and column are points enough for a plane
  Points points;
  for (int y = 0; y < depth.height(); y += kStep)
    for (int x = 0; x < depth.width(); x += kStep)
      if (depth(x, y) > 0.0f) points.push_back(point_in_colour(depth, x, y).cast<float>());
  const auto desk = choose_desk(find_planes(points, {}), kMounted, {});
  if (!desk) return std::nullopt;
  return DeskImage{std::move(name), std::move(depth), {}, desk->plane};
}

std::vector<DeskImage> measured_desks() {
  const char* named = std::getenv("FATHOM_REAL_DATA");
  const std::filesystem::path folder = std::filesystem::path(named ? named : FATHOM_REAL_DATA_DEFAULT) / "mOSD";
  std::vector<DeskImage> desks;
  if (!std::filesystem::exists(folder)) return desks;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    pcl::PointCloud<pcl::PointXYZL> cloud;
    if (pcl::io::loadPCDFile(file.string(), cloud) != 0) continue;
    Image<float> depth(static_cast<int>(cloud.width), static_cast<int>(cloud.height));
    Image<int> label(depth.width(), depth.height());
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth.pixels()[i] = std::isfinite(cloud[i].z) ? cloud[i].z : 0.0f;
      label.pixels()[i] = static_cast<int>(cloud[i].label);
    }
    if (auto desk = with_desk(file.stem().string(), std::move(depth))) {
      desk->label = std::move(label);
      desks.push_back(std::move(*desk));
    }
  }
  return desks;
}

}  // namespace fathom
