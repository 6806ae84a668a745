#include "sim/scene/liquid_edge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace fathom {
namespace {

constexpr double kSheet = 2e-6, kDeepest = 0.25e-3;  // [m]

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Sums of the outward normals of the edge's lines by vertex, as long as the lines; zero inside the mesh.
std::vector<Eigen::Vector2d> outward(const Mesh& mesh) {
  std::map<std::pair<int, int>, bool> lines;  // directed
  for (const Eigen::Vector3i& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) lines[{t[i], t[(i + 1) % 3]}] = true;
  std::vector<Eigen::Vector2d> normals(mesh.vertices.size(), Eigen::Vector2d::Zero());
  for (const auto& [line, unused] : lines) {
    if (lines.count({line.second, line.first})) continue;
    const Eigen::Vector2d along = (mesh.vertices[line.second] - mesh.vertices[line.first]).head<2>();
    for (const int vertex : {line.first, line.second}) normals[vertex] += Eigen::Vector2d(along.y(), -along.x());
  }
  return normals;
}

/// Distance from a point along a unit direction to the next wall but the one that it stands on.
double next_wall(const Eigen::Vector2d& point, const Eigen::Vector2d& direction, std::span<const Segment> walls) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : walls) {
    const Eigen::Vector2d along = wall.to - wall.from, towards = wall.from - point;
    const double facing = cross(direction, along);
    if (facing == 0.0) continue;
    const double distance = cross(towards, along) / facing, share = cross(towards, direction) / facing;
    if (distance > kSheet && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

}  // namespace

void draw_into_walls(std::span<const Segment> walls, const std::function<bool(const Eigen::Vector2d&)>& open,
                     Mesh& mesh) {
  const std::vector<Eigen::Vector2d> normals = outward(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i].isZero(0.0)) continue;
    const Eigen::Vector2d direction = normals[i].normalized();
    const Eigen::Vector2d point = mesh.vertices[i].head<2>();
    const double wall = next_wall(point, direction, walls);
    const bool sheet = !std::isfinite(wall) || open(point + 0.5 * wall * direction);
    mesh.vertices[i].head<2>() += (sheet ? kSheet : std::min(0.5 * wall, kDeepest)) * direction;
  }
}

}  // namespace fathom
