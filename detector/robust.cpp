#include "detector/robust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "detector/content_signs.h"
#include "detector/depth_noise.h"
#include "detector/mean_error.h"
#include "detector/pinhole.h"

namespace fathom {
namespace {

/// The measured points in the desk's frame; points that nothing was measured for stay what they are.
Points in_desk_frame(const Points& points, const Eigen::Isometry3d& desk_from_camera) {
  const Eigen::Matrix3f rotation = desk_from_camera.linear().cast<float>();
  const Eigen::Vector3f offset = desk_from_camera.translation().cast<float>();
  Points result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result[i] = rotation * points[i] + offset;
  return result;
}

double range_of(const Points& segment, double camera_height_m) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& point : segment) sum += point;
  const Eigen::Vector3d mean = (sum / static_cast<float>(segment.size())).cast<double>();
  return (mean - Eigen::Vector3d(0.0, 0.0, camera_height_m)).norm();
}

/// Far away the noise asks for more tolerance: 1.5 standard deviations, from 1 m on.
WallSearch search_at(double range_m, WallSearch search) {
  search.tolerance_m = std::max(search.tolerance_m, 1.5 * depth_noise_m(range_m));
  return search;
}

CupCandidate candidate_from(const Points& segment, const RoundWall& wall, double tolerance_m) {
  CupCandidate candidate;
  for (const Eigen::Vector3f& point : segment)
    if (wall.distance_of(point) < wall.radius_at(point.z()) + tolerance_m) candidate.points.push_back(point);
  candidate.width_m = 2.0 * wall.radius_at(wall.top_m);
  candidate.top_m = wall.top_m;
  candidate.band_points = wall.points;
  candidate.circle = Circle{wall.center, wall.radius_m, wall.rms_m};
  candidate.lean = wall.lean;
  return candidate;
}

std::string mm(double metres) { return fmt::format("{:.1f} mm", mm_from_metres(metres)); }

/// Why this open or closed round thing is no cup; empty when it is one.
std::string reason_against(const RoundWall& wall, const VesselRays& rays, double tolerance_m, const CupLimits& limits) {
  if (rays.lid_share() > limits.lid_share_max)
    return fmt::format("closed at the top: {:.0f} % of the lines of sight into it end at its rim",
                       100.0 * rays.lid_share());
  if (wall.top_m < limits.height_min_m || wall.top_m > limits.height_max_m)
    return fmt::format("height {} is outside {:g} to {:g} mm", mm(wall.top_m), mm_from_metres(limits.height_min_m),
                       mm_from_metres(limits.height_max_m));
  if (std::abs(wall.lean) > limits.lean_max)
    return fmt::format("wall leans {:.0f} deg as a bowl's", deg_from_radians(std::atan(wall.lean)));
  if (wall.radius_m < limits.radius_min_m || wall.radius_m > limits.radius_max_m)
    return fmt::format("radius {} is outside {:g} to {:g} mm", mm(wall.radius_m), mm_from_metres(limits.radius_min_m),
                       mm_from_metres(limits.radius_max_m));
  if (wall.radius_sigma_m > limits.radius_sigma_max_m)
    return fmt::format("radius {} is uncertain by {}: {:.0f} % of a circle is seen", mm(wall.radius_m),
                       mm(wall.radius_sigma_m), 100.0 * wall.arc_share);
  if (wall.rms_m > limits.evenness_max * tolerance_m)
    return fmt::format("no wall: points lie anywhere within {} of it", mm(tolerance_m));
  if (rays.beyond_share() > limits.beyond_share_max)
    return fmt::format("no wall: {:.0f} % of the lines of sight to it end behind it", 100.0 * rays.beyond_share());
  if (static_cast<int>(rays.inside.size()) < limits.inside_min)
    return fmt::format("nothing shows that it is open: {} points inside", rays.inside.size());
  return "";
}

struct KnownCup {
  std::optional<std::size_t> index;  ///< of the template
  Bottom bottom;
  std::string words;
};

/// The bottom of the template that has this radius and height, else where bottoms usually are.
KnownCup known_cup(const RoundWall& wall, const std::vector<CupTemplate>& templates, const RobustConfig& config) {
  KnownCup known{std::nullopt, {config.bottom.height_m, config.bottom.sigma_m}, "no template, a usual bottom"};
  double nearest = config.template_radius_m;
  for (std::size_t i = 0; i < templates.size(); ++i) {
    const CupTemplate& cup = templates[i];
    const double off = std::abs(cup.radius_m - wall.radius_m);
    if (off > nearest || std::abs(cup.height_m - wall.top_m) > config.template_height_m) continue;
    const Circle inside{Eigen::Vector2d::Zero(), cup.radius_m, 0.0};
    const auto seen = interior_height(cup.points, inside, InteriorSettings{});
    const double bottom = seen ? seen->mean_m : cup.liquid_threshold_m - kThresholdAboveBottomMetres;
    known = {i, {bottom, cup.bottom_sigma_m.value_or(config.template_bottom_sigma_m)}, "matches " + cup.name};
    nearest = off;
  }
  return known;
}

/// A liquid's surface is level; the raised bottom below a clear one leans by less than a degree.
std::string solid_words(const LevelSurface& surface, const MoundSlope& mound, const SurfaceSettings& settings) {
  const bool leans = surface.tilt_rad > settings.tilt_max_rad && surface.tilt_rad > 3.0 * surface.tilt_sigma_rad;
  if (leans)
    return fmt::format("its surface leans {:.0f} +- {:.0f} deg", deg_from_radians(surface.tilt_rad),
                       deg_from_radians(surface.tilt_sigma_rad));
  if (mound.slope_rad > settings.tilt_max_rad && mound.slope_rad > 3.0 * mound.sigma_rad)
    return fmt::format("it is heaped by {:.0f} +- {:.0f} deg", deg_from_radians(mound.slope_rad),
                       deg_from_radians(mound.sigma_rad));
  const double flat = settings.roughness_max * depth_noise_m(surface.range_m);
  if (surface.sd_m > flat) return fmt::format("its surface is uneven by {}", mm(surface.sd_m));
  return "";
}

CupEvidence evidence_of(const RoundWall& wall, const Points& inside, const std::optional<LevelSurface>& surface,
                        const Eigen::Isometry3d& desk_from_camera, const MeanError& errors, ContentSigns signs,
                        const KnownCup& known, const RobustConfig& config) {
  CupEvidence evidence{
      known.bottom, wall.top_m - config.rays.lid_m - known.bottom.height_m, {}, std::move(signs), known.words, ""};
  if (!surface) return evidence;
  evidence.readings.push_back({surface->middle.z(), errors.of_height(surface->points, surface->middle),
                               line_of_sight(desk_from_camera, surface->middle, config.baseline_m)});
  evidence.solid_words = solid_words(*surface, mound_slope(inside, wall, *surface, config.surface), config.surface);
  return evidence;
}

}  // namespace

Detection detect_robust(const Cloud& cloud, const DetectorSettings& settings) {
  const RobustConfig& config = settings.robust;
  Detection result;
  StageClock clock(result.stages);
  const auto found = find_desk(cloud.points, settings.prior, config.desk);
  clock.done("desk");
  if (const NoDesk* none = std::get_if<NoDesk>(&found)) {
    result.why = none->why;
    return result;
  }
  result.desk = std::get<PlaneFit>(found);
  const Eigen::Isometry3d to_desk = desk_from_camera(result.desk->plane);
  const double camera_height = result.desk->plane.offset;
  const Points points = in_desk_frame(cloud.points, to_desk);
  const MeanError errors(points, camera_height);
  const std::optional<Pinhole> pinhole = pinhole_of(cloud);

  std::vector<Points> segments = grid_segments(points, config.segments);
  clock.done("segments");
  for (Points& segment : segments) {
    const WallSearch search = search_at(range_of(segment, camera_height), config.wall);
    const std::vector<RoundWall> walls = find_round_walls(segment, search);
    clock.done("walls");
    result.segments += std::max<int>(1, static_cast<int>(walls.size()));
    if (walls.empty()) {
      CupCandidate none;
      none.rejected = "no round upright wall";
      none.points = std::move(segment);
      result.rejected.push_back({std::move(none), std::nullopt, std::nullopt});
      continue;
    }
    for (const RoundWall& wall : walls) {
      CupCandidate candidate = candidate_from(segment, wall, search.tolerance_m);
      const VesselRays rays = trace_vessel(points, camera_height, wall, config.rays);
      const auto surface = find_surface(rays.inside, wall, camera_height, config.surface);
      candidate.rejected = reason_against(wall, rays, search.tolerance_m, config.cup);
      if (!candidate.rejected.empty()) {
        RejectedSegment rejected{std::move(candidate), std::nullopt, std::nullopt};
        const bool open = rays.lid_share() <= config.cup.lid_share_max;
        if (surface && open) rejected.interior = InteriorHeight{surface->middle.z(), surface->sd_m, surface->points};
        result.rejected.push_back(std::move(rejected));
        continue;
      }
      DetectedCup cup;
      cup.candidate = std::move(candidate);
      cup.center_in_camera = to_desk.inverse() * Eigen::Vector3d(wall.center.x(), wall.center.y(), kWallHeight);
      cup.score_m = wall.rms_m;
      cup.radius_sigma_m = wall.radius_sigma_m;
      const KnownCup known = known_cup(wall, settings.templates, config);
      if (known.index) cup.match = TemplateMatch{*known.index, wall.rms_m, 0};
      ContentSigns signs;
      if (pinhole)
        signs = content_signs(cloud, *pinhole, to_desk, wall,
                              surface ? std::optional(surface->middle.z()) : std::nullopt, config.signs);
      if (surface) {
        cup.interior = InteriorHeight{surface->middle.z(), surface->sd_m, surface->points};
        cup.surface_sigma_m = errors.of_height(surface->points, surface->middle);
      }
      cup.evidence = evidence_of(wall, rays.inside, surface, to_desk, errors, std::move(signs), known, config);
      decide_content(cup, *cup.evidence, config.fill);
      result.cups.push_back(std::move(cup));
    }
    clock.done("content");
  }
  return result;
}

}  // namespace fathom
