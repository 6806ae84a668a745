#include "diagnosis/statistics/reml.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/dense.h"

namespace fathom {

namespace {

constexpr int kScoringSteps = 30;
constexpr double kEnoughChange = 1e-4;  // change of a variance, relative to all of them, at which scoring stops
constexpr double kSmallestStep = 0.25;  // of a variance with a prior, which is never 0

/// First derivatives of the log likelihood by the variances, and minus the expectation of the second ones.
struct Slopes {
  Eigen::VectorXd score;
  Eigen::MatrixXd information;
};

Eigen::LLT<Eigen::MatrixXd> covariance_factor(const Eigen::MatrixXd& known, const std::vector<Eigen::MatrixXd>& shapes,
                                              const Eigen::VectorXd& variances) {
  Eigen::MatrixXd total = known;
  for (Eigen::Index k = 0; k < variances.size(); ++k) total += variances[k] * shapes[k];
  return Eigen::LLT<Eigen::MatrixXd>(total);
}

Slopes slopes(const Eigen::VectorXd& contrasts, const Eigen::MatrixXd& known,
              const std::vector<Eigen::MatrixXd>& shapes, const std::vector<VariancePrior>& priors,
              const Eigen::VectorXd& variances) {
  const Eigen::Index count = variances.size();
  const Eigen::LLT<Eigen::MatrixXd> factor = covariance_factor(known, shapes, variances);
  const Eigen::VectorXd solved = factor.solve(contrasts);
  std::vector<Eigen::MatrixXd> weighted(count);
  Slopes result{Eigen::VectorXd(count), Eigen::MatrixXd(count, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    weighted[k] = factor.solve(shapes[k]);
    result.score[k] = 0.5 * (solved.dot(shapes[k] * solved) - weighted[k].trace());
  }
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index l = 0; l <= k; ++l)
      result.information(k, l) = result.information(l, k) =
          0.5 * weighted[k].cwiseProduct(weighted[l].transpose()).sum();
  for (Eigen::Index k = 0; k < count; ++k) {
    const double v = variances[k];
    if (priors[k].dof == 0.0) continue;
    result.score[k] += 0.5 * priors[k].dof * (priors[k].variance / v - 1.0) / v;
    result.information(k, k) += 0.5 * priors[k].dof / (v * v);
  }
  return result;
}

}  // namespace

double restricted_log_likelihood(const Eigen::VectorXd& contrasts, const Eigen::MatrixXd& known,
                                 const std::vector<Eigen::MatrixXd>& shapes, const Eigen::VectorXd& variances) {
  const Eigen::LLT<Eigen::MatrixXd> factor = covariance_factor(known, shapes, variances);
  return -factor.matrixLLT().diagonal().array().log().sum() - 0.5 * contrasts.dot(factor.solve(contrasts));
}

VarianceFit fit_variances(const Eigen::VectorXd& contrasts, const Eigen::MatrixXd& known,
                          const std::vector<Eigen::MatrixXd>& shapes, const std::vector<VariancePrior>& priors) {
  const auto count = static_cast<Eigen::Index>(shapes.size());
  if (count == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(0, 0)};
  // In units of the contrasts' own size, so that a variance of 1 is a large one.
  const double scale =
      contrasts.size() > 0 ? std::max(contrasts.squaredNorm() / static_cast<double>(contrasts.size()), 1e-300) : 1.0;
  const Eigen::VectorXd data = contrasts / std::sqrt(scale);
  const Eigen::MatrixXd floor = 1e-9 * Eigen::MatrixXd::Identity(data.size(), data.size());
  const Eigen::MatrixXd known_scaled = known / scale + floor;
  std::vector<VariancePrior> scaled = priors;
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(count, 0.3);
  for (Eigen::Index k = 0; k < count; ++k) {
    scaled[k].variance /= scale;
    if (scaled[k].dof > 0.0) variances[k] = scaled[k].variance;
  }
  Eigen::MatrixXd covariance;
  for (int step = 0; step < kScoringSteps; ++step) {
    auto [score, information] = slopes(data, known_scaled, shapes, scaled, variances);
    covariance = pseudo_inverse(information);
    // Variances at 0 that want to be negative stay there; the others move.
    for (Eigen::Index k = 0; k < count; ++k) {
      if (variances[k] > 0.0 || score[k] > 0.0) continue;
      information.row(k).setZero();
      information.col(k).setZero();
      information(k, k) = 1.0;
      score[k] = 0.0;
    }
    Eigen::VectorXd next = variances + pseudo_inverse(information) * score;
    for (Eigen::Index k = 0; k < count; ++k)
      next[k] = std::max(next[k], scaled[k].dof > 0.0 ? kSmallestStep * variances[k] : 0.0);
    const bool is_done = (next - variances).norm() <= kEnoughChange * (next.norm() + 1e-300);
    variances = next;
    if (is_done) break;
  }
  return {scale * variances, scale * scale * covariance};
}

}  // namespace fathom
