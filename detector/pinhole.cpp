#include "detector/pinhole.h"

#include <cmath>

namespace fathom {
namespace {

struct Line {
  double slope, offset, rms;
};

/// Least squares from sums, about the middle of `u`.
class LineSums {
 public:
  void add(double u, double v) { ++n_, u_ += u, v_ += v, uu_ += u * u, uv_ += u * v, vv_ += v * v; }
  std::optional<Line> line() const {
    const double spread = uu_ - u_ * u_ / n_;
    if (n_ < 100 || !(spread > n_)) return std::nullopt;  // fewer points, or of one column, give no line
    const double slope = (uv_ - u_ * v_ / n_) / spread;
    const double rest = (vv_ - v_ * v_ / n_ - slope * slope * spread) / n_;
    return Line{slope, (v_ - slope * u_) / n_, std::sqrt(std::max(0.0, rest))};
  }

 private:
  double n_ = 0, u_ = 0, v_ = 0, uu_ = 0, uv_ = 0, vv_ = 0;
};

}  // namespace

std::optional<Pinhole> pinhole_of(const Cloud& cloud) {
  if (cloud.height < 2) return std::nullopt;
  LineSums across, down;
  constexpr int kStep = 7;  // 6 000 of 307 200 points, from all columns and rows
  for (int row = 0; row < cloud.height; row += kStep)
    for (int column = row % kStep; column < cloud.width; column += kStep) {
      const Eigen::Vector3d point = cloud.points[static_cast<std::size_t>(row) * cloud.width + column].cast<double>();
      if (!point.allFinite() || !(point.z() > 0.0)) continue;
      across.add(column + 0.5, point.x() / point.z());
      down.add(row + 0.5, point.y() / point.z());
    }
  const auto x = across.line(), y = down.line();
  if (!x || !y || !(x->slope > 0.0) || !(y->slope > 0.0)) return std::nullopt;
  if (x->rms > 0.5 * x->slope || y->rms > 0.5 * y->slope) return std::nullopt;
  return Pinhole{1.0 / x->slope, 1.0 / y->slope, -x->offset / x->slope, -y->offset / y->slope};
}

}  // namespace fathom
