#include "detector/robust_settings.h"

#include <cmath>

#include "core/units.h"
#include "detector/detector_settings.h"

namespace fathom {

RobustConfig read_robust_config(const JsonReader& json) {
  json.allow_only({"plane_threshold_mm",
                   "plane_share_min",
                   "prior_angle_max_deg",
                   "prior_height_max_mm",
                   "reach_mm",
                   "segment_points_min",
                   "wall_tolerance_mm",
                   "hypotheses",
                   "radius_mm",
                   "height_mm",
                   "lean_max_deg",
                   "radius_sigma_max_mm",
                   "lid_mm",
                   "lid_share_max",
                   "beyond_share_max",
                   "inside_points_min",
                   "interior_margin_mm",
                   "interior_points_min",
                   "bottom_mm",
                   "bottom_sigma_mm",
                   "baseline_mm",
                   "index",
                   "liquid_prior",
                   "liquid_sure",
                   "dry_sure",
                   "kind_sure"});
  constexpr Range kShare{0.0, 1.0};
  constexpr int kMany = 1'000'000;
  RobustConfig config;
  config.desk.threshold_m = json.metres_or("plane_threshold_mm", config.desk.threshold_m, kPositive);
  config.desk.share_min = json.number_or("plane_share_min", config.desk.share_min, {0.0, 1.0, true});
  config.desk.prior_angle_max_rad = radians_from_deg(
      json.number_or("prior_angle_max_deg", deg_from_radians(config.desk.prior_angle_max_rad), {0.0, 180.0, true}));
  config.desk.prior_height_max_m = json.metres_or("prior_height_max_mm", config.desk.prior_height_max_m, kPositive);
  config.segments.reach_m = json.metres_or("reach_mm", config.segments.reach_m, {100.0, 5000.0});
  config.segments.points_min = json.integer_or("segment_points_min", config.segments.points_min, 1, kMany);
  config.wall.tolerance_m = json.metres_or("wall_tolerance_mm", config.wall.tolerance_m, kPositive);
  config.wall.hypotheses = json.integer_or("hypotheses", config.wall.hypotheses, 1, kMany);
  read_mm_range(json, "radius_mm", config.cup.radius_min_m, config.cup.radius_max_m);
  read_mm_range(json, "height_mm", config.cup.height_min_m, config.cup.height_max_m);
  config.cup.lean_max = std::tan(
      radians_from_deg(json.number_or("lean_max_deg", deg_from_radians(std::atan(config.cup.lean_max)), {0.0, 80.0})));
  config.cup.radius_sigma_max_m = json.metres_or("radius_sigma_max_mm", config.cup.radius_sigma_max_m, kPositive);
  config.rays.lid_m = json.metres_or("lid_mm", config.rays.lid_m, kNonNegative);
  config.cup.lid_share_max = json.number_or("lid_share_max", config.cup.lid_share_max, kShare);
  config.cup.beyond_share_max = json.number_or("beyond_share_max", config.cup.beyond_share_max, kShare);
  config.cup.inside_min = json.integer_or("inside_points_min", config.cup.inside_min, 0, kMany);
  config.surface.margin_m = json.metres_or("interior_margin_mm", config.surface.margin_m, kNonNegative);
  config.surface.points_min = json.integer_or("interior_points_min", config.surface.points_min, 3, kMany);
  config.bottom.height_m = json.metres_or("bottom_mm", config.bottom.height_m, kNonNegative);
  config.bottom.sigma_m = json.metres_or("bottom_sigma_mm", config.bottom.sigma_m, kPositive);
  config.baseline_m = json.metres_or("baseline_mm", config.baseline_m, kNonNegative);
  config.fill.index = json.number_or("index", config.fill.index, {1.0, 2.0, true});
  config.fill.liquid_prior = json.number_or("liquid_prior", config.fill.liquid_prior, kShare);
  config.fill.liquid_sure = json.number_or("liquid_sure", config.fill.liquid_sure, {0.5, 1.0});
  config.fill.dry_sure = json.number_or("dry_sure", config.fill.dry_sure, {0.5, 1.0});
  config.fill.kind_sure = json.number_or("kind_sure", config.fill.kind_sure, {0.5, 1.0});
  return config;
}

}  // namespace fathom
