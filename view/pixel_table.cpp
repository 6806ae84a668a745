#include "view/pixel_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/parallel.h"
#include "sim/render/pixel_rays.h"
#include "sim/render/truth.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace {

/// More pixels than an Xtion's would make a page of many megabytes.
constexpr double kMostPixels = 640.0 * 480.0;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Where the paper has a point that both rays see through one level surface, from a level baseline above it.
double paper_height(const Rig& rig, const PixelRays& rays) {
  const Body* liquid = rays.seen.around;
  if (!liquid || !liquid->level || rays.camera_bends.size() != 1 || rays.projector_bends.size() != 1) return kNone;
  const Eigen::Vector3d camera = rig.camera_in_world(), projector = rig.projector_in_world();
  const Eigen::Vector3d middle = 0.5 * (camera + projector), from_middle = rays.seen.point - middle;
  constexpr double kLevel = 1e-6;  // [m]
  if (std::fabs(camera.z() - projector.z()) > kLevel || middle.z() <= *liquid->level) return kNone;
  return rays.seen.point.z() + theory::raised_height_at(*liquid->level - rays.seen.point.z(),
                                                        {-from_middle.z(), rig.sensor.baseline,
                                                         from_middle.head<2>().norm(), liquid->medium.n});
}

/// Fills one row; returns its bends.
std::vector<BentPixel> trace_row(const Rig& rig, const PointLight& projector, int row, PixelTable& table) {
  std::vector<BentPixel> bent;
  for (int column = 0; column < table.columns; ++column) {
    const std::size_t pixel = static_cast<std::size_t>(row) * table.columns + column;
    const double x_px = column * table.stride + 0.5, y_px = row * table.stride + 0.5;
    const auto rays = rays_of_pixel(projector, rig, x_px, y_px);
    if (!rays) continue;
    table.points[pixel] = rays->seen.point;
    table.object[pixel] = static_cast<std::uint16_t>(rays->seen.object);
    table.path[pixel] = static_cast<std::uint8_t>(path_of(rays->seen));
    if (rays->light)
      table.apparent_depth[pixel] =
          triangulated_depth(rig, rig.direction_in_world(x_px, y_px), rays->light->direction).value_or(0.0);
    if (!rays->camera_bends.empty() || !rays->projector_bends.empty())
      bent.push_back(
          {static_cast<std::uint32_t>(pixel), rays->camera_bends, rays->projector_bends, paper_height(rig, *rays)});
  }
  return bent;
}

/// Depths [m] in whole steps of what 16 bits can count to the greatest; 0 stays 0.
Json packed_depths(const std::vector<double>& depths, double step) {
  std::vector<std::uint16_t> codes;
  for (const double depth : depths) codes.push_back(static_cast<std::uint16_t>(std::lround(depth / step)));
  return packed(codes);
}

double greatest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

}  // namespace

double PixelTable::farthest() const {
  double most = 0.0;
  const auto reach = [&](const std::vector<Eigen::Vector3d>& places) {
    for (const Eigen::Vector3d& place : places) most = std::max(most, place.cwiseAbs().maxCoeff());
  };
  reach(points);
  for (const BentPixel& pixel : bent) reach(pixel.camera), reach(pixel.projector);
  return most;
}

PixelTable trace_pixels(const Setup& setup, const PointLight& projector, const Image<float>& depth) {
  const Rig& rig = setup.rig;
  PixelTable table{};
  table.stride = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(depth.size()) / kMostPixels)));
  table.columns = (depth.width() + table.stride - 1) / table.stride;
  table.rows = (depth.height() + table.stride - 1) / table.stride;
  const std::size_t pixels = static_cast<std::size_t>(table.columns) * table.rows;
  table.path.resize(pixels);
  table.object.resize(pixels);
  table.points.resize(pixels, Eigen::Vector3d::Zero());
  table.apparent_depth.resize(pixels);
  for (int row = 0; row < table.rows; ++row)
    for (int column = 0; column < table.columns; ++column)
      table.measured_depth.push_back(depth(column * table.stride, row * table.stride));
  std::vector<std::vector<BentPixel>> bent(table.rows);
  parallel_ranges(table.rows, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) bent[row] = trace_row(rig, projector, row, table);
  });
  for (std::vector<BentPixel>& row : bent) std::move(row.begin(), row.end(), std::back_inserter(table.bent));
  return table;
}

Json json_from_pixels(const PixelTable& table, const PlaceCode& code) {
  std::vector<std::int16_t> points, bends, paper;
  for (const Eigen::Vector3d& point : table.points) code.add(point, points);
  std::vector<std::uint32_t> bent;
  std::vector<std::uint8_t> counts;
  for (const BentPixel& pixel : table.bent) {
    bent.push_back(pixel.pixel);
    for (const auto* ray : {&pixel.camera, &pixel.projector}) {
      counts.push_back(static_cast<std::uint8_t>(ray->size()));
      for (const Eigen::Vector3d& bend : *ray) code.add(bend, bends);
    }
    constexpr std::int16_t kNoHeight = -32768;
    paper.push_back(std::isfinite(pixel.paper_height)
                        ? static_cast<std::int16_t>(std::lround(pixel.paper_height / code.step()))
                        : kNoHeight);
  }
  const double depth_step = std::max({greatest(table.measured_depth), greatest(table.apparent_depth), 1e-3}) / 65535.0;
  return {{"stride", table.stride},
          {"columns", table.columns},
          {"rows", table.rows},
          {"depth_step_m", depth_step},
          {"path", packed(table.path)},
          {"object", packed(table.object)},
          {"point", packed(points)},
          {"apparent", packed_depths(table.apparent_depth, depth_step)},
          {"measured", packed_depths(table.measured_depth, depth_step)},
          {"bent", packed(bent)},
          {"bend_counts", packed(counts)},
          {"bends", packed(bends)},
          {"paper_height", packed(paper)}};
}

}  // namespace fathom
