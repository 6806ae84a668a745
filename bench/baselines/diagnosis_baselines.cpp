#include "bench/baselines/diagnosis_baselines.h"

#include <algorithm>
#include <cmath>

#include "core/dense.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {
namespace {

struct Scaled {
  Eigen::VectorXd residual;
  Eigen::MatrixXd sensitivities;  ///< unit columns; 0 where nothing sees the effect
};

/// The residual and each candidate's first sensitivity, in the observables' units.
Scaled unscaled(const Evidence& evidence) {
  const Eigen::VectorXd residual = measured_minus_predicted(evidence);
  Scaled s{residual, Eigen::MatrixXd(residual.size(), static_cast<Eigen::Index>(evidence.candidates.size()))};
  for (Eigen::Index k = 0; k < s.sensitivities.cols(); ++k)
    s.sensitivities.col(k) = evidence.candidates[k].sensitivity.col(0);
  return s;
}

/// Not colwise().normalized(), which makes NaN of a column of zeros, and thereby of all that it is multiplied with.
void normalize(Eigen::MatrixXd& columns) {
  for (auto column : columns.colwise()) column.normalize();
}

/// As if errors were independent.
Scaled scaled(const Evidence& evidence) {
  Scaled s = unscaled(evidence);
  const Eigen::Index n = s.residual.size();
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  const Groups cells = group_by(evidence.observations, cell_key);
  const auto members = cells.members();
  std::vector<double> squares(observables.count, 0.0), dof = squares, alone = squares, count = squares;
  for (const auto& rows : members) {
    const double mean = s.residual(rows).mean();
    const int observable = observables.of[rows[0]];
    squares[observable] += (s.residual(rows).array() - mean).square().sum();
    dof[observable] += static_cast<double>(rows.size()) - 1.0;
  }
  for (std::size_t i = 0; i < evidence.observations.size(); ++i)
    if (const Observation& o = evidence.observations[i]; dof[observables.of[i]] == 0.0)
      alone[observables.of[i]] += o.repeat_sd * o.repeat_sd / o.repeats, ++count[observables.of[i]];
  Eigen::ArrayXd sds(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int of = observables.of[i];
    const double variance = dof[of] > 0.0 ? squares[of] / dof[of] : alone[of] / count[of];
    sds[i] = variance > 0.0 ? std::sqrt(variance) : 1.0;
  }
  s.residual.array() /= sds;
  s.sensitivities.array().colwise() /= sds;
  normalize(s.sensitivities);
  return s;
}

/// With the covariance that the diagnosis has.
Scaled whitened(const Evidence& evidence) {
  Scaled s = unscaled(evidence);
  const Covariance covariance = estimate_covariance(evidence, s.residual);
  s.residual = covariance.whiten(s.residual);
  s.sensitivities = covariance.whiten(s.sensitivities);
  normalize(s.sensitivities);
  return s;
}

/// χ² + k log n of the least-squares fit of some columns.
double bic(const Scaled& s, const std::vector<int>& effects) {
  double chi2 = s.residual.squaredNorm();
  if (!effects.empty()) {
    const Eigen::MatrixXd X = s.sensitivities(Eigen::all, effects);
    chi2 = (s.residual - X * least_squares(X, s.residual)).squaredNorm();
  }
  return chi2 + static_cast<double>(effects.size()) * std::log(static_cast<double>(s.residual.size()));
}

/// Ascending: one more as long as BIC falls.
std::vector<int> forward_selection(const Scaled& s) {
  std::vector<int> chosen;
  double best = bic(s, chosen);
  for (bool grows = true; grows;) {
    grows = false;
    std::vector<int> next = chosen;
    for (int k = 0; k < s.sensitivities.cols(); ++k) {
      if (std::find(chosen.begin(), chosen.end(), k) != chosen.end()) continue;
      std::vector<int> tried = chosen;
      tried.push_back(k);
      if (const double value = bic(s, tried); value < best) {
        best = value;
        next = tried;
        grows = true;
      }
    }
    chosen = next;
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

std::vector<int> greedy_bic(const Evidence& evidence) { return forward_selection(scaled(evidence)); }

std::vector<int> gls_bic(const Evidence& evidence) { return forward_selection(whitened(evidence)); }

std::vector<int> lasso_bic(const Evidence& evidence) {
  if (evidence.candidates.empty()) return {};
  const Scaled s = scaled(evidence);
  const Eigen::MatrixXd G = s.sensitivities.transpose() * s.sensitivities;
  const Eigen::VectorXd b = s.sensitivities.transpose() * s.residual;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  std::vector<int> chosen;
  double best = bic(s, {});
  for (double penalty = b.cwiseAbs().maxCoeff(); penalty > 0.01 * b.cwiseAbs().maxCoeff(); penalty *= 0.85) {
    for (int sweep = 0; sweep < 200; ++sweep)
      for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double free = b[k] - G.row(k).dot(x) + x[k];
        x[k] = std::copysign(std::max(0.0, std::abs(free) - penalty), free);
      }
    std::vector<int> active;
    for (int k = 0; k < x.size(); ++k)
      if (x[k] != 0.0) active.push_back(k);
    if (const double value = bic(s, active); value < best) {
      best = value;
      chosen = active;
    }
  }
  return chosen;
}

std::vector<int> largest_correlation(const Evidence& evidence) {
  if (evidence.candidates.empty()) return {};
  const Scaled s = scaled(evidence);
  Eigen::Index best = 0;
  const double z = (s.sensitivities.transpose() * s.residual).cwiseAbs().maxCoeff(&best);
  return z > 3.0 ? std::vector<int>{static_cast<int>(best)} : std::vector<int>{};
}

}  // namespace fathom
