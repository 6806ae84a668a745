#include "detector/plane_ransac.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/rng.h"

namespace fathom {
namespace {

constexpr std::uint64_t kSeed = 1;  // equal clouds give equal planes

/// Plane in single precision: heights are wanted of very many points.
struct FastPlane {
  explicit FastPlane(const Plane& plane)
      : normal(plane.normal.cast<float>()), offset(static_cast<float>(plane.offset)) {}
  float height_of(const Eigen::Vector3f& point) const { return normal.dot(point) + offset; }

  Eigen::Vector3f normal;
  float offset;
};

std::optional<Plane> plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d across = (b - a).cross(c - a);
  const double twice_area = across.norm();
  constexpr double kSmallest = 1e-5;  // m²: triangles of a few millimetres say nothing about a desk
  if (!(twice_area > kSmallest)) return std::nullopt;
  const Eigen::Vector3d normal = across / twice_area;
  const double offset = -normal.dot(a);
  return offset >= 0.0 ? Plane{normal, offset} : Plane{-normal, -offset};
}

/// Σ over points, for a least-squares plane.
class Moments {
 public:
  explicit Moments(const Eigen::Vector3d& origin) : origin_(origin) {}

  void add(const Eigen::Vector3f& point) {
    const Eigen::Vector3d p = point.cast<double>() - origin_;
    sum_ += p;
    squares_ += p * p.transpose();
    ++count_;
  }
  int count() const { return count_; }
  PlaneFit fit() const {
    const Eigen::Vector3d mean = sum_ / count_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares_ / count_ - mean * mean.transpose());
    Eigen::Vector3d normal = axes.eigenvectors().col(0);
    double offset = -normal.dot(origin_ + mean);
    if (offset < 0.0) normal = -normal, offset = -offset;
    return {{normal, offset}, count_, std::sqrt(std::max(0.0, axes.eigenvalues()(0)))};
  }

 private:
  Eigen::Vector3d origin_, sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  int count_ = 0;
};

}  // namespace

Points draw_points(const Points& points, int count) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / static_cast<std::size_t>(count));
  Points drawn;
  drawn.reserve(points.size() / step + 1);
  Rng rng(kSeed);
  for (std::size_t begin = 0; begin < points.size(); begin += step) {
    const std::size_t width = std::min(step, points.size() - begin);
    const Eigen::Vector3f& point = points[begin + rng.below(static_cast<std::uint32_t>(width))];
    if (point.allFinite()) drawn.push_back(point);
  }
  return drawn;
}

PlaneFit fit_plane(const Points& points, const Plane& plane, double threshold_m) {
  Moments moments(-plane.offset * plane.normal);
  const FastPlane fast(plane);
  const float threshold = static_cast<float>(threshold_m);
  for (const Eigen::Vector3f& point : points)
    if (std::abs(fast.height_of(point)) <= threshold) moments.add(point);
  return moments.count() < 3 ? PlaneFit{plane, moments.count(), 0.0} : moments.fit();
}

int count_inliers(const Points& points, const Plane& plane, double threshold_m) {
  const FastPlane fast(plane);
  const float threshold = static_cast<float>(threshold_m);
  int count = 0;
  for (const Eigen::Vector3f& point : points) count += std::abs(fast.height_of(point)) <= threshold;
  return count;
}

void erase_inliers(Points& points, const Plane& plane, double threshold_m) {
  const FastPlane fast(plane);
  const float threshold = static_cast<float>(threshold_m);
  std::erase_if(points, [&](const Eigen::Vector3f& point) { return std::abs(fast.height_of(point)) <= threshold; });
}

std::optional<Plane> largest_plane(const Points& points, double threshold_m, int iterations_max, int round,
                                   const std::function<bool(const Plane&)>& may_be) {
  if (points.size() < 3) return std::nullopt;
  Rng rng(kSeed, round);
  const auto any = [&]() -> Eigen::Vector3d {
    return points[rng.below(static_cast<std::uint32_t>(points.size()))].cast<double>();
  };
  std::optional<Plane> best;
  int most = 0;
  double needed = iterations_max;
  for (int i = 0; i < std::min<double>(needed, iterations_max); ++i) {
    const Eigen::Vector3d a = any(), b = any(), c = any();
    const std::optional<Plane> plane = plane_through(a, b, c);
    if (!plane || !may_be(*plane)) continue;
    const int inliers = count_inliers(points, *plane, threshold_m);
    if (inliers <= most) continue;
    most = inliers;
    best = plane;
    const double share = static_cast<double>(inliers) / static_cast<double>(points.size());
    needed = std::log(0.01) / std::log1p(-std::min(0.999, share * share * share));  // 99 % (Fischler & Bolles 1981)
  }
  if (!best) return std::nullopt;
  const PlaneFit wide = fit_plane(points, *best, threshold_m);
  return fit_plane(points, wide.plane, threshold_m).plane;
}

}  // namespace fathom
