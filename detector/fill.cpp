#include "detector/fill.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

/// Normal density of readings whose bottoms are the same, up to a factor that all hypotheses share.
class ReadingLikelihood {
 public:
  ReadingLikelihood(const std::vector<SurfaceReading>& readings, const Bottom& bottom)
      : off_(static_cast<Eigen::Index>(readings.size())) {
    const auto count = off_.size();
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(count, count, bottom.sigma_m * bottom.sigma_m);
    for (Eigen::Index i = 0; i < count; ++i) {
      covariance(i, i) += readings[i].sigma_m * readings[i].sigma_m;
      off_(i) = readings[i].height_m - bottom.height_m;
    }
    inverse_ = covariance.inverse();
  }
  /// `rises` [m]: of the bottom that each view sees.
  double operator()(const Eigen::VectorXd& rises) const {
    const Eigen::VectorXd rest = off_ - rises;
    return std::exp(-0.5 * rest.dot(inverse_ * rest));
  }

  /// Standard deviation of a rise that all readings share; 1 m without readings.
  double sigma_m() const { return off_.size() == 0 ? 1.0 : 1.0 / std::sqrt(inverse_.sum()); }

 private:
  Eigen::VectorXd off_;
  Eigen::MatrixXd inverse_;
};

struct Posterior {
  double evidence;  ///< mean likelihood over all fills
  FillDecision::Level level;
};

/// `weight_of(fill)`: likelihood of the fill, which changes over no less than `sigma_m`.
template <class Weight>
Posterior over_fills(double low_m, double high_m, double sigma_m, Weight weight_of) {
  const int steps = static_cast<int>(std::clamp(2.0 * (high_m - low_m) / sigma_m, 100.0, 10000.0));
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double fill = low_m + (high_m - low_m) * (i + 0.5) / steps, weight = weight_of(fill);
    sum += weight;
    first += weight * fill;
    second += weight * fill * fill;
  }
  if (!(sum > 0.0)) return {0.0, {0.0, 0.0}};
  const double mean = first / sum;
  return {sum / steps, {mean, std::sqrt(std::max(0.0, second / sum - mean * mean))}};
}

double log_normal(double value, double median, double spread) {
  return std::exp(-0.5 * std::pow(std::log(value / median) / spread, 2)) / spread;
}

/// Likelihood of the brightness under a clear liquid relative to all else.
double clear_ratio(const ContentSigns& signs, double fill_m, const FillSettings& settings) {
  if (!signs.brightness || !(*signs.brightness > 0.0)) return 1.0;
  const double expected = settings.clear_brightness * std::exp(-2.0 * settings.clear_absorption_per_m * fill_m);
  const double ratio = log_normal(*signs.brightness, expected, settings.clear_spread) /
                       log_normal(*signs.brightness, settings.other_brightness, settings.other_spread);
  return std::clamp(ratio, 1.0 / settings.brightness_ratio_max, settings.brightness_ratio_max);
}

}  // namespace

FillDecision decide_fill(const std::vector<SurfaceReading>& readings, const Bottom& bottom, double fill_max_m,
                         const ContentSigns& signs, const FillSettings& settings) {
  const auto count = static_cast<Eigen::Index>(readings.size());
  const ReadingLikelihood likelihood(readings, bottom);
  const auto raised = [&](double fill) {
    Eigen::VectorXd rises(count);
    for (Eigen::Index i = 0; i < count; ++i) rises(i) = apparent_rise(fill, readings[i].sight, settings.index);
    return rises;
  };
  const auto covered = [&](double fill) -> Eigen::VectorXd { return Eigen::VectorXd::Constant(count, fill); };
  const double high = std::max(fill_max_m, 2.0 * settings.fill_min_m);
  const double low = settings.fill_min_m, sigma = likelihood.sigma_m();
  Posterior transparent = over_fills(
      low, high, sigma, [&](double fill) { return likelihood(raised(fill)) * clear_ratio(signs, fill, settings); });
  // What raises a bottom is n − 1, and 1/n of it: ∂ ln(1 − 1/n) / ∂n = 1 / (n (n − 1)), within a tenth at any
  // incidence.
  const double index_share = settings.index_sigma / (settings.index * (settings.index - 1.0));
  transparent.level.sigma_m = std::hypot(transparent.level.sigma_m, index_share * transparent.level.fill_m);
  const Posterior opaque = over_fills(low, high, sigma, [&](double fill) { return likelihood(covered(fill)); });

  const double dry = (1.0 - settings.liquid_prior) * likelihood(Eigen::VectorXd::Zero(count));
  const double clear_liquid = 0.5 * settings.liquid_prior * transparent.evidence;
  const double opaque_liquid = 0.5 * settings.liquid_prior * opaque.evidence * signs.opaque;
  const double liquid = clear_liquid + opaque_liquid;
  // All of them vanish where a height is far from everything, as deep below the bottom: then nothing is known.
  constexpr double kTiny = 1e-300;
  return {(liquid + kTiny * 0.5) / (liquid + dry + kTiny), (opaque_liquid + kTiny * 0.5) / (liquid + kTiny),
          transparent.level, opaque.level};
}

}  // namespace fathom
