#include "detector/liquid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fathom {

double InteriorHeight::standard_error_m() const { return sd_m / std::sqrt(static_cast<double>(points)); }

std::optional<InteriorHeight> interior_height(const Points& points, const Circle& circle,
                                              const InteriorSettings& settings) {
  const double radius = circle.radius_m - settings.margin_m;
  if (radius <= 0.0) return std::nullopt;
  std::vector<double> heights;
  double sum = 0.0;
  for (const Eigen::Vector3f& point : points) {
    const double height = point.z();
    if (height < settings.low_m || height > settings.high_m) continue;
    if ((point.head<2>().cast<double>() - circle.center).squaredNorm() >= radius * radius) continue;
    heights.push_back(height);
    sum += height;
  }
  const int count = static_cast<int>(heights.size());
  if (count < std::max(settings.points_min, 2)) return std::nullopt;
  const double mean = sum / count;
  double squares = 0.0;
  for (const double height : heights) squares += (height - mean) * (height - mean);
  return InteriorHeight{mean, std::sqrt(squares / (count - 1)), count};
}

Liquid decide_liquid(const std::optional<InteriorHeight>& height, double threshold_m) {
  if (!height) return Liquid::kUnknown;
  return height->mean_m > threshold_m ? Liquid::kYes : Liquid::kNo;
}

}  // namespace fathom
