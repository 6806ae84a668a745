#include "detector/detector_settings.h"

#include "core/files.h"
#include "core/input_policy.h"
#include "core/units.h"
#include "detector/robust_settings.h"

namespace fathom {
namespace {

PaperConfig read_paper_config(const JsonReader& json) {
  constexpr int kMany = 1'000'000;
  PaperConfig config;
  config.plane.threshold_m = json.metres_or("plane_threshold_mm", config.plane.threshold_m, kPositive);
  config.plane.planes_max = json.integer_or("planes_max", config.plane.planes_max, 1, 100);
  config.plane.share_min = json.number_or("plane_share_min", config.plane.share_min, {0.0, 1.0, true});
  config.plane.iterations_max = json.integer_or("plane_iterations_max", config.plane.iterations_max, 1, kMany);
  config.plane.prior_angle_max_rad = radians_from_deg(
      json.number_or("prior_angle_max_deg", deg_from_radians(config.plane.prior_angle_max_rad), {0.0, 180.0, true}));
  config.plane.prior_height_max_m = json.metres_or("prior_height_max_mm", config.plane.prior_height_max_m, kPositive);
  config.height_max_m = json.metres_or("height_max_mm", config.height_max_m, kPositive);
  config.cluster_distance_m = json.metres_or("cluster_distance_mm", config.cluster_distance_m, kPositive);
  config.cluster_points_min = json.integer_or("cluster_points_min", config.cluster_points_min, 1, kMany);
  read_mm_range(json, "width_mm", config.cup.width_min_m, config.cup.width_max_m);
  config.cup.top_min_m = json.metres_or("top_min_mm", config.cup.top_min_m, kNonNegative);
  read_mm_range(json, "band_mm", config.cup.band_low_m, config.cup.band_high_m);
  config.cup.circle_rms_max_m = json.metres_or("circle_rms_max_mm", config.cup.circle_rms_max_m, kPositive);
  read_mm_range(json, "radius_mm", config.cup.radius_min_m, config.cup.radius_max_m);
  config.icp.score_max_m = json.metres_or("icp_score_max_mm", config.icp.score_max_m, kPositive);
  config.icp.iterations_max = json.integer_or("icp_iterations_max", config.icp.iterations_max, 1, kMany);
  config.interior.margin_m = json.metres_or("interior_margin_mm", config.interior.margin_m, kNonNegative);
  config.interior.points_min = json.integer_or("interior_points_min", config.interior.points_min, 2, kMany);
  return config;
}

RegistrationConfig read_registration_config(const JsonReader& json) {
  json.allow_only({"normal_radius_mm", "feature_radius_mm", "iterations", "score_max_mm"});
  RegistrationConfig config;
  config.normal_radius_m = json.metres_or("normal_radius_mm", config.normal_radius_m, kPositive);
  config.feature_radius_m = json.metres_or("feature_radius_mm", config.feature_radius_m, kPositive);
  config.iterations = json.integer_or("iterations", config.iterations, 1, 1'000'000);
  config.score_max_m = json.metres_or("score_max_mm", config.score_max_m, kPositive);
  return config;
}

}  // namespace

void read_mm_range(const JsonReader& json, std::string_view key, double& low_m, double& high_m) {
  if (!json.has(key)) return;
  const Eigen::Vector2d range = json.at(key).vector2();
  if (range[0] < 0.0 || range[1] <= range[0]) json.fail_at(key, "must be two rising lengths [low, high]");
  low_m = metres_from_mm(range[0]);
  high_m = metres_from_mm(range[1]);
}

DetectorSettings detector_settings(const JsonReader& json) {
  json.allow_only({"plane_threshold_mm",  "planes_max",
                   "plane_share_min",     "plane_iterations_max",
                   "prior_angle_max_deg", "prior_height_max_mm",
                   "height_max_mm",       "cluster_distance_mm",
                   "cluster_points_min",  "width_mm",
                   "top_min_mm",          "band_mm",
                   "circle_rms_max_mm",   "radius_mm",
                   "icp_score_max_mm",    "icp_iterations_max",
                   "interior_margin_mm",  "interior_points_min",
                   "templates",           "robust",
                   "registration"});
  DetectorSettings settings;
  settings.paper = read_paper_config(json);
  if (json.has("registration")) settings.registration = read_registration_config(json.at("registration"));
  if (json.has("robust")) settings.robust = read_robust_config(json.at("robust"));
  for (const JsonReader& item : json.items_or_none("templates"))
    settings.templates.push_back(load_template(path_named_in(item.file(), item.pointer(), item.text())));
  if (settings.templates.empty()) settings.templates = load_templates(data_directory() / "templates");
  return settings;
}

DetectorSettings detector_settings(const std::filesystem::path& config) {
  const Json json = config.empty() ? Json::object() : read_json(config);
  return detector_settings(JsonReader(json, config.string()));
}

}  // namespace fathom
