// By hand, because one function of PCL's that its own needs is in its library of features, which has 100,000 symbols
// that every start of every program would look up (detector/CMakeLists.txt). A test compares them with PCL's.
#include "detector/fpfh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace fathom {
namespace {

constexpr int kBins = 11;

/// Three angles between two oriented points, each as a share of its range: of the normals about the line between the
/// points, and of the second and the first normal to the frame that line and first normal span.
std::optional<Eigen::Array3f> angles(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                                     const Eigen::Vector3f& other_point, const Eigen::Vector3f& other_normal) {
  Eigen::Vector3f line = other_point - point;
  const float length = line.norm();
  if (length == 0.0f) return std::nullopt;
  Eigen::Vector3f first = normal, second = other_normal;
  float along = first.dot(line) / length;
  // The first is that whose normal is nearer to the line.
  if (const float other_along = second.dot(line) / length; std::abs(other_along) > std::abs(along)) {
    std::swap(first, second);
    line = -line;
    along = -other_along;
  }
  Eigen::Vector3f v = line.cross(first);
  if (v.norm() == 0.0f) return std::nullopt;
  v.normalize();
  const float about = std::atan2(first.cross(v).dot(second), first.dot(second));
  return Eigen::Array3f(0.5f * about / std::numbers::pi_v<float> + 0.5f, 0.5f * (v.dot(second) + 1.0f),
                        0.5f * (along + 1.0f));
}

int bin_of(float share) { return std::clamp(static_cast<int>(std::floor(kBins * share)), 0, kBins - 1); }

/// Of the pairs that a point makes with its neighbours.
Fpfh pair_histograms(std::size_t point, const Points& points, const Points& normals,
                     const std::vector<Neighbour>& neighbours) {
  Fpfh histograms{};
  const float each = 100.0f / (static_cast<float>(neighbours.size()) - 1.0f);
  for (const auto& [index, distance] : neighbours) {
    if (index == static_cast<int>(point)) continue;
    const auto found = angles(points[point], normals[point], points[index], normals[index]);
    if (!found) continue;
    for (int angle = 0; angle < 3; ++angle) histograms[kBins * angle + bin_of((*found)[angle])] += each;
  }
  return histograms;
}

}  // namespace

std::vector<Fpfh> fast_point_feature_histograms(const Points& points, const Points& normals,
                                                const std::vector<std::vector<Neighbour>>& neighbours) {
  std::vector<Fpfh> of_pairs, result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    of_pairs.push_back(pair_histograms(i, points, normals, neighbours[i]));
  for (std::size_t i = 0; i < points.size(); ++i) {
    Fpfh& sum = result[i];
    for (const auto& [index, squared_distance] : neighbours[i])
      if (squared_distance > 0.0f)
        for (std::size_t bin = 0; bin < sum.size(); ++bin) sum[bin] += of_pairs[index][bin] / squared_distance;
    for (auto part = sum.begin(); part != sum.end(); part += kBins) {
      float all = 0.0f;
      for (auto bin = part; bin != part + kBins; ++bin) all += *bin;
      if (all > 0.0f)
        for (auto bin = part; bin != part + kBins; ++bin) *bin *= 100.0f / all;
    }
  }
  return result;
}

}  // namespace fathom
