#include "detector/cup_template.h"

#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>

#include <algorithm>
#include <cmath>

#include "core/cloud_file.h"
#include "core/error.h"
#include "core/input_policy.h"
#include "core/json.h"
#include "core/units.h"
#include "detector/pcl_points.h"
#include "detector/quiet_pcl.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr float kTemplateSpacingMetres = 0.003f;  // about twice a pixel's footprint at 1 m: finer says nothing new

double rounded_mm(double metres) { return std::round(mm_from_metres(metres) * 100.0) / 100.0; }

}  // namespace

Points thinned(const Points& points) {
  const QuietPcl quiet;
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(pcl_cloud(points));
  grid.setLeafSize(kTemplateSpacingMetres, kTemplateSpacingMetres, kTemplateSpacingMetres);
  PclCloud result;
  grid.filter(result);
  return points_from(result);
}

Points in_template_frame(const Points& in_desk, const Circle& circle) {
  const double distance = circle.center.norm();
  const Eigen::Vector2d away = distance > 0.0 ? Eigen::Vector2d(circle.center / distance) : Eigen::Vector2d::UnitY();
  Points result;
  result.reserve(in_desk.size());
  for (const Eigen::Vector3f& point : in_desk) {
    const double x = point.x() - circle.center.x(), y = point.y() - circle.center.y();
    result.emplace_back(static_cast<float>(away.y() * x - away.x() * y),
                        static_cast<float>(away.x() * x + away.y() * y), point.z());
  }
  return result;
}

CupTemplate load_template(const fs::path& path) {
  const Json json = read_json(path);
  const JsonReader reader(json, path.string());
  reader.allow_only({"name", "cloud", "liquid_threshold_mm", "height_mm", "radius_mm", "bottom_sigma_mm"});
  CupTemplate cup;
  cup.name = reader.text("name");
  cup.points = finite_points(read_cloud(path_named_in(path.string(), "/cloud", reader.text("cloud"))));
  if (cup.points.empty()) reader.fail_at("cloud", "has no finite points");
  cup.liquid_threshold_m = metres_from_mm(reader.number("liquid_threshold_mm", kPositive));
  cup.height_m = metres_from_mm(reader.number("height_mm", kPositive));
  cup.radius_m = metres_from_mm(reader.number("radius_mm", kPositive));
  if (reader.has("bottom_sigma_mm"))
    cup.bottom_sigma_m = metres_from_mm(reader.number("bottom_sigma_mm", kNonNegative));
  return cup;
}

std::vector<CupTemplate> load_templates(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty()) throw Error(folder.string(), "holds no cup template (*.json)");
  std::sort(files.begin(), files.end());
  std::vector<CupTemplate> cups;
  cups.reserve(files.size());
  for (const fs::path& file : files) cups.push_back(load_template(file));
  return cups;
}

void save_template(const fs::path& folder, const CupTemplate& cup) {
  Image<CloudPoint> cloud(static_cast<int>(cup.points.size()), 1);
  for (std::size_t i = 0; i < cup.points.size(); ++i)
    cloud.pixels()[i] = {cup.points[i].x(), cup.points[i].y(), cup.points[i].z(), 0.0f};
  write_pcd(folder / (cup.name + ".pcd"), cloud);
  Json json = {{"name", cup.name},
               {"cloud", cup.name + ".pcd"},
               {"liquid_threshold_mm", rounded_mm(cup.liquid_threshold_m)},
               {"height_mm", rounded_mm(cup.height_m)},
               {"radius_mm", rounded_mm(cup.radius_m)}};
  if (cup.bottom_sigma_m) json["bottom_sigma_mm"] = rounded_mm(*cup.bottom_sigma_m);
  write_json(folder / (cup.name + ".json"), json);
}

}  // namespace fathom
