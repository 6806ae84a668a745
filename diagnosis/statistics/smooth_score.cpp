#include "diagnosis/statistics/smooth_score.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr Eigen::Index kRank = 60;
constexpr double kEnough = 1e-3;  // of the process's variance may be left out
constexpr double kShared = 0.5;
constexpr std::array<double, 6> kSizes{0.25, 0.5, 1.0, 2.0, 4.0, 8.0};  // times the errors

struct Place {
  int observable, liquid, region;
  Eigen::Vector3d position;  ///< fill, distance, lateral over their ranges
  double size;
};

std::vector<Place> places(const Evidence& evidence, const Covariance& covariance) {
  const auto& observations = evidence.observations;
  const auto n = static_cast<Eigen::Index>(observations.size());
  const Eigen::MatrixXd x = places_in_ranges(observations);
  const Groups observables = group_by(observations, [](const Observation& o) { return o.observable; });
  const Groups liquids = group_by(observations, [](const Observation& o) { return "=" + o.factors.liquid; });
  const Groups regions = group_by(observations, [](const Observation& o) { return "=" + o.factors.region; });
  const Eigen::VectorXd errors = covariance.total.diagonal() - covariance.nuisance.rowwise().squaredNorm();
  std::vector<double> mean_square;
  for (const auto& rows : observables.members()) mean_square.push_back(errors(rows).mean());
  std::vector<Place> result;
  for (Eigen::Index i = 0; i < n; ++i)
    result.push_back({observables.of[i], liquids.of[i], regions.of[i], x.row(i).transpose(),
                      std::sqrt(mean_square[observables.of[i]])});
  return result;
}

double kernel(const Place& a, const Place& b) {
  if (a.observable != b.observable) return 0.0;
  const double same = (a.liquid == b.liquid ? 1.0 : kShared) * (a.region == b.region ? 1.0 : kShared);
  return a.size * b.size * same * std::exp(-0.5 * (a.position - b.position).squaredNorm());
}

struct Spectrum {
  Eigen::MatrixXd vectors;
  Eigen::VectorXd values, projections;  ///< of smoothᵀ smooth; of smoothᵀ residual on its vectors
};

Spectrum spectrum(const Eigen::MatrixXd& smooth, const Eigen::VectorXd& residual) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(smooth.transpose() * smooth);
  return {eigen.eigenvectors(), eigen.eigenvalues().cwiseMax(0.0),
          eigen.eigenvectors().transpose() * (smooth.transpose() * residual)};
}

double log_evidence_of_size(const Spectrum& s, double size) {
  const Eigen::ArrayXd wider = 1.0 + size * size * s.values.array();
  return 0.5 * (size * size * s.projections.array().square() / wider - wider.log()).sum();
}

}  // namespace

Eigen::MatrixXd smooth_factor(const Evidence& evidence, const Covariance& covariance) {
  const std::vector<Place> at = places(evidence, covariance);
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::VectorXd left(n), relative(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    left[i] = kernel(at[i], at[i]);
    relative[i] = 1.0 / left[i];
  }
  Eigen::MatrixXd factor(n, std::min(n, kRank));
  Eigen::Index rank = 0;
  while (rank < factor.cols()) {
    Eigen::Index pivot = 0;
    if (left.cwiseProduct(relative).maxCoeff(&pivot) < kEnough) break;
    for (Eigen::Index i = 0; i < n; ++i) factor(i, rank) = kernel(at[i], at[pivot]);
    factor.col(rank) -= factor.leftCols(rank) * factor.row(pivot).head(rank).transpose();
    factor.col(rank) /= std::sqrt(left[pivot]);
    left -= factor.col(rank).cwiseAbs2();
    ++rank;
  }
  return factor.leftCols(rank);
}

double smooth_log_evidence(const Eigen::MatrixXd& smooth, const Eigen::VectorXd& residual) {
  const Spectrum s = spectrum(smooth, residual);
  Eigen::Array<double, kSizes.size(), 1> logs;
  for (std::size_t k = 0; k < kSizes.size(); ++k) logs[k] = log_evidence_of_size(s, kSizes[k]);
  return logs.maxCoeff() + std::log((logs - logs.maxCoeff()).exp().mean());
}

Eigen::VectorXd smooth_map(const Eigen::MatrixXd& factor, const Eigen::MatrixXd& smooth,
                           const Eigen::VectorXd& residual) {
  const Spectrum s = spectrum(smooth, residual);
  double best = kSizes[0];
  for (const double size : kSizes)
    if (log_evidence_of_size(s, size) > log_evidence_of_size(s, best)) best = size;
  const Eigen::VectorXd weights = best * best * s.projections.array() / (1.0 + best * best * s.values.array());
  return factor * (s.vectors * weights);
}

}  // namespace fathom
