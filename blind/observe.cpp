#include "blind/observe.h"

#include <Eigen/QR>
#include <cmath>

#include "blind/device_law.h"
#include "blind/laboratory.h"

namespace fathom::blind {
namespace {

constexpr double kMiddleRadius = 0.012, kInsideRadius = 0.030;  // of the paper's cup: inner radius less 10 mm
constexpr int kFewestBlocks = 4;
constexpr double kDeskSigma = 0.05e-3;     // of a desk's height and its tilt over 0.1 m: dust, not noise, limits it
constexpr double kPatternSigma = 0.05e-3;  // of a region's height: which dots happen to lie on a slope
constexpr double kGrainShare = 0.47;       // deviation of a dot's brightness (Landau 2016)

/// The middle, or the quarter of the ring; -1 outside.
int region_of(const Eigen::Vector2d& place) {
  const double r = place.norm();
  if (r > kInsideRadius) return -1;
  if (r < kMiddleRadius) return 0;
  if (std::abs(place.x()) > std::abs(place.y())) return place.x() > 0.0 ? 1 : 2;
  return place.y() > 0.0 ? 3 : 4;
}

/// Pixels in which the inside may be seen.
Raster inside_raster(const Placement& placement) {
  Raster raster = near_cup(placement);
  const Eigen::Vector2i margin = (raster.high - raster.low) / 5;
  return {raster.low + margin, raster.high - margin, 3};
}

/// Metres of height per pixel of disparity.
double height_per_px(const Eyes& eyes, const Block& block) {
  return (believed_point(eyes, block.pixel, block.disparity_px + 0.5) -
          believed_point(eyes, block.pixel, block.disparity_px - 0.5))
      .z();
}

}  // namespace

double DeskPlane::above(const Eigen::Vector3d& point) const {
  return (point.z() - height - slope.dot(point.head<2>())) / std::sqrt(1.0 + slope.squaredNorm());
}

DeskPlane fit_plane(std::span<const Eigen::Vector3d> points) {
  Eigen::MatrixXd a(points.size(), 3);
  Eigen::VectorXd z(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    a.row(i) << 1.0, points[i].x(), points[i].y();
    z[i] = points[i].z();
  }
  const Eigen::Vector3d x = a.colPivHouseholderQr().solve(z);
  return {x[0], {x[1], x[2]}};
}

Eigen::Vector3d believed_point(const Eyes& believed_eyes, const Eigen::Vector2d& pixel, double disparity_px) {
  return believed_eyes.camera + believed_eyes.world_from_camera * cloud_point(pixel, depth_of(disparity_px));
}

Look look(const World& world, const Placement& placement, std::uint64_t standing) {
  Look seen;
  const Eyes eyes = eyes_of(world.sensor);
  for (int v = 120; v <= 420; v += 60)
    for (int u = 40; u <= 520; u += 80) follow(world, eyes, {{u, v}, 0}, false, seen.desk);
  if (!placement.has_cup()) return seen;
  const Raster raster = inside_raster(placement);
  seen.inside = match(world, dots_for(world.sensor, raster, 0.5, 0.95), true, raster, standing);
  return seen;
}

Readings readings_of(const Look& look, const World& world, const Placement& placement, int trials) {
  const Eyes eyes = eyes_of(believed(placement).sensor);
  const double common = world.warm_up_px * std::exp(-world.seconds / 600.0);
  const auto point_at = [&](const Eigen::Vector2d& pixel, double disparity_px) {
    return believed_point(eyes, pixel, disparity_px + field_px(world, pixel, disparity_px) + common);
  };
  std::vector<Eigen::Vector3d> of_desk;
  for (const SeenDot& dot : look.desk) of_desk.push_back(point_at(dot.pixel, dot.disparity_px));
  const DeskPlane desk = fit_plane(of_desk);
  Readings readings{};
  const double slope_sigma = kDeskSigma / 0.1;
  readings[kDesk] = {desk.height, kDeskSigma};
  readings[kDesk + 1] = {desk.slope.x(), slope_sigma};
  readings[kDesk + 2] = {desk.slope.y(), slope_sigma};
  if (!placement.has_cup()) return readings;

  const Matched& matched = look.inside;
  std::array<int, kRegions> blocks{};
  std::array<std::vector<double>, kRegions> shares;  // of each dot in a region's mean [m per px]
  std::array<double, 2> light{};                     // of the inside, of the wall
  std::array<int, 2> lit{};
  for (const Block& block : matched.blocks) {
    const Eigen::Vector3d p = point_at(block.pixel, block.disparity_px);
    const int region = region_of(p.head<2>() - Eigen::Vector2d(placement.lateral, placement.distance));
    if (region >= 0 || block.lit == Lit::inner_wall) {
      light[region < 0] += block.brightness;
      ++lit[region < 0];
    }
    if (region < 0) continue;
    ++blocks[region];
    readings[region].value += desk.above(p);
    shares[region].resize(matched.dots.size());
    const double scale = height_per_px(eyes, block);
    for (int k = block.first; k < block.first + block.count; ++k)
      shares[region][matched.members[k].dot] += scale * matched.members[k].error_weight;
  }
  const double dot_px2 = kStaticDotPx * kStaticDotPx + kTemporalDotPx * kTemporalDotPx / trials;
  for (int region = 0; region < kRegions; ++region) {
    if (blocks[region] < kFewestBlocks) {
      readings[region] = {};
      continue;
    }
    readings[region].value /= blocks[region];
    double variance = kPatternSigma * kPatternSigma;
    for (std::size_t i = 0; i < shares[region].size(); ++i) {
      const double share = shares[region][i] / blocks[region] * matched.dot_sigma[i];
      variance += dot_px2 * share * share;
    }
    readings[region].sigma = std::sqrt(variance);
  }
  for (int i = 0; i < 2; ++i)
    if (lit[i] >= kFewestBlocks)
      readings[kBrightness + i] = {std::log(light[i] / lit[i]), kGrainShare / std::sqrt(static_cast<double>(lit[i]))};
  return readings;
}

Readings observe(const World& world, const Placement& placement, int trials, std::uint64_t standing) {
  return readings_of(look(world, placement, standing), world, placement, trials);
}

std::optional<MeanHeight> mean_height(std::span<const CloudPoint> cloud, const Placement& placement) {
  const Eyes eyes = eyes_of(believed(placement).sensor);
  const Eigen::Vector2d cup(placement.lateral, placement.distance);
  std::vector<Eigen::Vector3d> desk, inside;
  for (const CloudPoint& point : cloud) {
    const Eigen::Vector3d p =
        eyes.camera + eyes.world_from_camera * Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
    const double r = (p.head<2>() - cup).norm();
    if (r < kInsideRadius)
      inside.push_back(p);
    else if (r > 0.055 && std::abs(p.z()) < 0.012)
      desk.push_back(p);
  }
  if (inside.size() < 10 || desk.size() < 10) return std::nullopt;
  const DeskPlane plane = fit_plane(desk);
  double sum = 0.0, squares = 0.0;
  for (const Eigen::Vector3d& p : inside) sum += plane.above(p);
  const double points = static_cast<double>(inside.size());
  const double mean = sum / points;
  for (const Eigen::Vector3d& p : inside) squares += (plane.above(p) - mean) * (plane.above(p) - mean);
  return MeanHeight{mean, std::sqrt(squares / (points - 1.0)), static_cast<int>(inside.size())};
}

}  // namespace fathom::blind
