#include "sim/scene/mesh_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace fathom {
namespace {

/// For every vertex the number of the first one at its place.
std::vector<int> first_at_place(const Mesh& mesh) {
  const auto place = [&](int i) {
    const Eigen::Vector3d& v = mesh.vertices[i];
    return std::tuple(v.x(), v.y(), v.z());
  };
  std::vector<int> order(mesh.vertices.size()), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::pair(place(a), a) < std::pair(place(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && place(order[i - 1]) == place(order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

/// An edge of a triangle, the smaller number first.
struct Edge {
  int low, high;
  bool upward;  ///< whether the triangle passes it from low to high
  int triangle;

  std::pair<int, int> ends() const { return {low, high}; }
};

/// All edges of all triangles but those without length, equal ends side by side.
std::vector<Edge> sorted_edges(const Mesh& mesh) {
  const std::vector<int> first = first_at_place(mesh);
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int from = first[mesh.triangles[t][i]], to = first[mesh.triangles[t][(i + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to, static_cast<int>(t)});
    }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
  return edges;
}

/// Calls `visit(begin, end)` for each run of edges with the same ends.
template <class Visit>
void for_each_edge(const Mesh& mesh, Visit visit) {
  const std::vector<Edge> edges = sorted_edges(mesh);
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(), [&](const Edge& edge) { return edge.ends() != begin->ends(); });
    visit(begin, end);
    begin = end;
  }
}

double volume(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles)
    six_volumes += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six_volumes / 6.0;
}

}  // namespace

bool encloses_volume(const Mesh& mesh) {
  bool closed = true;
  for_each_edge(mesh, [&](auto begin, auto end) {
    closed = closed && 2 * std::count_if(begin, end, [](const Edge& edge) { return edge.upward; }) == end - begin;
  });
  return closed && volume(mesh) > 0.0;
}

std::vector<int> patches(const Mesh& mesh) {
  std::vector<int> patch(mesh.triangles.size());
  std::iota(patch.begin(), patch.end(), 0);
  const auto root = [&](int t) {
    while (patch[t] != t) t = patch[t] = patch[patch[t]];
    return t;
  };
  for_each_edge(mesh, [&](auto begin, auto end) {
    if (end - begin == 2) patch[root(begin->triangle)] = root((begin + 1)->triangle);
  });
  for (std::size_t t = 0; t < patch.size(); ++t) patch[t] = root(static_cast<int>(t));
  return patch;
}

}  // namespace fathom
