#include "sim/scene/plane_section.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace fathom {
namespace {

/// The same point whichever end of the edge comes first.
Eigen::Vector2d cut(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double z) {
  const auto key = [](const Eigen::Vector3d& v) { return std::tuple(v.z(), v.x(), v.y()); };
  const bool ordered = key(a) < key(b);
  const Eigen::Vector3d &low = ordered ? a : b, &high = ordered ? b : a;
  const double t = (z - low.z()) / (high.z() - low.z());
  return low.head<2>() + t * (high - low).head<2>();
}

/// Points in which an odd number of segments end, sorted by x.
std::vector<Eigen::Vector2d> loose_ends(const std::vector<Segment>& segments) {
  std::map<std::pair<double, double>, int> ends;
  for (const Segment& segment : segments) {
    ++ends[{segment.from.x(), segment.from.y()}];
    ++ends[{segment.to.x(), segment.to.y()}];
  }
  std::vector<Eigen::Vector2d> loose;
  for (const auto& [point, count] : ends)
    if (count % 2 == 1) loose.emplace_back(point.first, point.second);
  return loose;
}

void join_loose_ends(double bridge, std::vector<Segment>& segments) {
  const std::vector<Eigen::Vector2d> loose = loose_ends(segments);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < loose.size(); ++i)
    for (std::size_t j = i + 1; j < loose.size() && loose[j].x() - loose[i].x() < bridge; ++j)
      if (const double gap = (loose[j] - loose[i]).norm(); gap < bridge) pairs.emplace_back(gap, i, j);
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> joined(loose.size(), false);
  for (const auto& [gap, i, j] : pairs) {
    if (joined[i] || joined[j]) continue;
    joined[i] = joined[j] = true;
    segments.push_back({loose[i], loose[j]});
  }
}

}  // namespace

std::vector<Segment> plane_section(std::span<const Triangle> triangles, double z, double bridge) {
  std::vector<Segment> segments;
  for (const Triangle& triangle : triangles) {
    Eigen::Vector2d ends[2];
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d &a = triangle[i], &b = triangle[(i + 1) % 3];
      if ((a.z() >= z) != (b.z() >= z)) ends[count++] = cut(a, b, z);
    }
    if (count == 2 && ends[0] != ends[1]) segments.push_back({ends[0], ends[1]});
  }
  join_loose_ends(bridge, segments);
  return segments;
}

}  // namespace fathom
