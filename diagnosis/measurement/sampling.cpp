#include "diagnosis/measurement/sampling.h"

#include <algorithm>
#include <cmath>
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

}  // namespace

void weigh_by_sampling(std::span<SensedPoint> points, double focal_px) {
  std::vector<Eigen::Vector2i> pixels;
  pixels.reserve(points.size());
  for (const SensedPoint& sensed : points) {
    const Eigen::Vector2d tangent = sensed.point.head<2>().cast<double>() / sensed.point.z();
    const Eigen::Vector2d pixel = focal_px * tangent + 0.5 * Eigen::Vector2d(kImageWidth_px, kImageHeight_px);
    pixels.emplace_back(static_cast<int>(std::floor(pixel.x())), static_cast<int>(std::floor(pixel.y())));
  }
  const Counts counts(pixels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    int reach = 1;
    while (reach < kFarthest_px && counts.within(pixels[i], reach) <= kNeighbours) ++reach;
    points[i].weight = static_cast<float>(reach * reach);
  }
}

}  // namespace fathom
