#include "diagnosis/measurement/cloud_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace fathom {
namespace {

constexpr int kFarthest_px = 16, kNeighbours = 2;

/// Numbers of points in any rectangle of the image.
class Counts {
 public:
  explicit Counts(std::span<const Eigen::Vector2i> pixels) : sums_((kWidth + 1) * (kHeight + 1), 0) {
    for (const Eigen::Vector2i& pixel : pixels)
      if (pixel.x() >= 0 && pixel.x() < kWidth && pixel.y() >= 0 && pixel.y() < kHeight)
        ++sum(pixel.x() + 1, pixel.y() + 1);
    for (int y = 1; y <= kHeight; ++y)
      for (int x = 1; x <= kWidth; ++x) sum(x, y) += sum(x - 1, y) + sum(x, y - 1) - sum(x - 1, y - 1);
  }

  int within(const Eigen::Vector2i& pixel, int reach) const {
    const auto column = [](int x) { return std::clamp(x, 0, kWidth); };
    const auto row = [](int y) { return std::clamp(y, 0, kHeight); };
    const int left = column(pixel.x() - reach), right = column(pixel.x() + reach + 1), top = row(pixel.y() - reach),
              bottom = row(pixel.y() + reach + 1);
    return sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top);
  }

 private:
  static constexpr int kWidth = static_cast<int>(kImageWidth_px), kHeight = static_cast<int>(kImageHeight_px);
  int& sum(int x, int y) { return sums_[static_cast<std::size_t>(y) * (kWidth + 1) + x]; }
  int sum(int x, int y) const { return sums_[static_cast<std::size_t>(y) * (kWidth + 1) + x]; }
  std::vector<int> sums_;
};

/// Far outside of the image for points that none shows.
Eigen::Vector2i pixel_of(const Eigen::Vector3f& point, double focal_px) {
  constexpr int kFar = 1'000'000;
  if (!(point.z() > 0.0f)) return {kFar, kFar};
  const Eigen::Vector2d tangent = point.head<2>().cast<double>() / point.z();
  const Eigen::Vector2d pixel = focal_px * tangent + 0.5 * Eigen::Vector2d(kImageWidth_px, kImageHeight_px);
  const auto number = [](double at) { return static_cast<int>(std::floor(std::clamp<double>(at, -kFar, kFar))); };
  return {number(pixel.x()), number(pixel.y())};
}

/// [px] of each from the second nearest other, along rows and columns.
std::vector<int> distances_px(std::span<const Eigen::Vector2i> pixels) {
  const Counts counts(pixels);
  std::vector<int> distances;
  distances.reserve(pixels.size());
  for (const Eigen::Vector2i& pixel : pixels) {
    int reach = 1;
    while (reach < kFarthest_px && counts.within(pixel, reach) <= kNeighbours) ++reach;
    distances.push_back(reach);
  }
  return distances;
}

/// Half of the area that points stand for has them as near each other as that, or nearer.
int median_by_area(std::span<const int> distances) {
  std::array<double, kFarthest_px + 1> areas{};
  double half = 0.0;
  for (const int distance : distances) areas[distance] += distance * distance, half += 0.5 * distance * distance;
  int median = 1;
  for (double area = areas[median]; area < half; area += areas[median]) ++median;
  return median;
}

}  // namespace

void weigh_by_sampling(std::span<SensedPoint> points, double focal_px) {
  std::vector<Eigen::Vector2i> pixels;
  pixels.reserve(points.size());
  for (const SensedPoint& sensed : points) pixels.push_back(pixel_of(sensed.point, focal_px));
  const std::vector<int> distances = distances_px(pixels);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].weight = static_cast<float>(distances[i] * distances[i]);
}

Points thinned_evenly(Points points, double focal_px) {
  std::vector<Eigen::Vector2i> pixels;
  pixels.reserve(points.size());
  for (const Eigen::Vector3f& point : points) pixels.push_back(pixel_of(point, focal_px));
  const int width = median_by_area(distances_px(pixels));
  if (width == 1) return points;
  std::set<std::pair<int, int>> squares;
  std::erase_if(points, [&](const Eigen::Vector3f& point) {
    const Eigen::Vector2i pixel = pixel_of(point, focal_px);
    return !squares.emplace(pixel.x() / width, pixel.y() / width).second;
  });
  return points;
}

}  // namespace fathom
