#include "detector/cup_template.h"

#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>

#include <algorithm>
#include <cmath>

#include "core/cloud_file.h"
#include "core/error.h"
#include "core/fields.h"
#include "core/input_policy.h"
#include "core/units.h"
#include "detector/pcl_points.h"
#include "detector/quiet_pcl.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr float kTemplateSpacingMetres = 0.003f;  // about twice a pixel's footprint at 1 m: finer says nothing new

std::span<const Field<CupTemplate>> template_fields() {
  static const Field<CupTemplate> fields[] = {
      {"name", &CupTemplate::name, "what detections call the cup", true},
      {"cloud",
       Part<CupTemplate>{[](const JsonReader& json, CupTemplate& cup) {
                           const fs::path cloud = path_named_in(json.file(), json.pointer(), json.text());
                           cup.points = finite_points(read_cloud(cloud));
                           if (cup.points.empty()) json.fail("has no finite points");
                         },
                         [](const CupTemplate& cup) { return Json(cup.name + ".pcd"); }, R"({"type": "string"})",
                         "a path"},
       "its points, beside this file: metres, origin on the desk below the axis, z up, y away from the sensor", true},
      {"liquid_threshold_mm", Length{&CupTemplate::liquid_threshold_m}, kPositive,
       "a mean height inside above this is a liquid", true},
      {"height_mm", Length{&CupTemplate::height_m}, kPositive, "of the rim above the desk", true},
      {"radius_mm", Length{&CupTemplate::radius_m}, kPositive, "45 mm above the desk", true},
      {"bottom_sigma_mm",
       Part<CupTemplate>{[](const JsonReader& json, CupTemplate& cup) {
                           cup.bottom_sigma_m = metres_from_mm(json.number(kNonNegative));
                         },
                         [](const CupTemplate& cup) {
                           return cup.bottom_sigma_m ? Json(mm_from_metres(*cup.bottom_sigma_m)) : Json();
                         }},
       kNonNegative, "standard deviation of the bottom's mean height"}};
  return fields;
}

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
  CupTemplate cup{};
  read_fields(reader, template_fields(), cup);
  return cup;
}

std::vector<KeyTable> template_key_tables() {
  return {{"", "", "A cup template", key_rows(template_fields(), CupTemplate{})}};
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
  Json json = json_from_fields(template_fields(), cup);
  for (Json& value : json)
    if (value.is_number()) value = std::round(value.get<double>() * 100.0) / 100.0;
  write_json(folder / (cup.name + ".json"), json);
}

}  // namespace fathom
