#include "diagnosis/unit/warm_up.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace fathom {

std::optional<WarmUp> warm_up_of(std::span<const TimedDisparity> readings) {
  constexpr std::size_t kFewest = 5;
  constexpr double kShortest_s = 60.0, kLongest_s = 7200.0, kFiner = 1.15;
  const auto count = static_cast<Eigen::Index>(readings.size());
  if (readings.size() < kFewest) return std::nullopt;
  std::optional<WarmUp> best;
  double least = 0.0;
  for (double fades_s = kShortest_s; fades_s < kLongest_s; fades_s *= kFiner) {
    Eigen::MatrixXd law(count, 2);
    Eigen::VectorXd seen(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      law.row(i) << 1.0, std::exp(-readings[i].time_s / fades_s);
      seen[i] = readings[i].disparity_px;
    }
    const Eigen::Matrix2d normal = law.transpose() * law;
    if (std::abs(normal.determinant()) < 1e-9) continue;
    const Eigen::Vector2d fitted = normal.ldlt().solve(law.transpose() * seen);
    const double left = (seen - law * fitted).squaredNorm();
    if (best && left >= least) continue;
    least = left;
    const double variance = left / static_cast<double>(count - 3);
    best = WarmUp{fitted[1], fades_s, std::sqrt(variance * normal.inverse()(1, 1))};
  }
  return best;
}

}  // namespace fathom
