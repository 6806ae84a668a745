#include "diagnosis/unit/warm_up.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace fathom {

namespace {

/// offset + amplitude exp(−t / fades_s).
struct Fit {
  double fades_s, amplitude_px;
  double squares_px2;      ///< that it leaves
  double amplitude_share;  ///< variance of the amplitude over that of a reading
};

std::optional<Fit> fit(std::span<const TimedDisparity> readings, double fades_s) {
  const auto count = static_cast<Eigen::Index>(readings.size());
  Eigen::MatrixXd law(count, 2);
  Eigen::VectorXd seen(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    law.row(i) << 1.0, std::exp(-readings[i].time_s / fades_s);
    seen[i] = readings[i].disparity_px;
  }
  const Eigen::Matrix2d normal = law.transpose() * law;
  if (!(normal.determinant() > 1e-9)) return std::nullopt;
  const Eigen::Vector2d fitted = normal.ldlt().solve(law.transpose() * seen);
  return Fit{fades_s, fitted[1], (seen - law * fitted).squaredNorm(), normal.inverse()(1, 1)};
}

}  // namespace

std::optional<WarmUp> warm_up_of(std::span<const TimedDisparity> readings) {
  constexpr std::size_t kFewest = 5;
  constexpr double kShortest_s = 60.0, kLongest_s = 7200.0, kFiner = 1.02, kSure = 3.0;
  if (readings.size() < kFewest) return std::nullopt;
  std::vector<Fit> fits;
  for (double fades_s = kShortest_s; fades_s < kLongest_s; fades_s *= kFiner)
    if (const auto one = fit(readings, fades_s)) fits.push_back(*one);
  if (fits.empty()) return std::nullopt;
  const Fit& best = *std::ranges::min_element(fits, {}, &Fit::squares_px2);
  const double variance = best.squares_px2 / static_cast<double>(readings.size() - 3);
  // The profile over all times: the farthest amplitude whose squares are not more than the least and one variance.
  double sigma = 0.0;
  for (const Fit& other : fits) {
    const double rest = variance - (other.squares_px2 - best.squares_px2);
    if (rest < 0.0) continue;
    sigma = std::max(sigma, std::abs(other.amplitude_px - best.amplitude_px) + std::sqrt(rest * other.amplitude_share));
  }
  if (std::abs(best.amplitude_px) < kSure * sigma) return std::nullopt;
  return WarmUp{best.amplitude_px, best.fades_s, sigma};
}

}  // namespace fathom
