#include "diagnosis/statistics/next_measurement.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

constexpr double kSettled = 3.0;  // σ
constexpr std::size_t kLikeliest = 4;

/// Changes of old and new observations by effects, per prior scale.
Eigen::MatrixXd signatures(const Evidence& evidence, const Design& design, const std::vector<int>& effects) {
  const auto n = static_cast<Eigen::Index>(evidence.observations.size());
  std::vector<Eigen::VectorXd> columns;
  for (const int effect : effects)
    for (std::size_t k = 0; k < evidence.candidates[effect].parameters.size(); ++k) {
      Eigen::VectorXd column(n + design.error_sd.size());
      column << evidence.candidates[effect].signature.col(k), design.signatures[effect].col(k);
      columns.push_back(evidence.candidates[effect].parameters[k].prior_scale * column);
    }
  Eigen::MatrixXd result(n + design.error_sd.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = columns[k];
  return result;
}

/// Old and new observations with nuisances as parameters of their own.
class Augmented {
 public:
  Augmented(const Evidence& evidence, const Covariance& covariance, const Design& design)
      : old_(covariance.total - covariance.nuisance * covariance.nuisance.transpose()), design_(design) {
    const Eigen::Index added = design.error_sd.size(), priors = covariance.nuisance.cols();
    Eigen::MatrixXd new_nuisances = design.nuisances;
    for (Eigen::Index k = 0; k < priors; ++k) new_nuisances.col(k) *= evidence.nuisances[k].sigma;
    nuisances_ = Eigen::MatrixXd::Zero(old_.rows() + added, priors + design.own_nuisances.cols());
    nuisances_.topLeftCorner(old_.rows(), priors) = covariance.nuisance;
    nuisances_.bottomLeftCorner(added, priors) = new_nuisances;
    nuisances_.bottomRightCorner(added, design.own_nuisances.cols()) = design.own_nuisances;
    nuisances_ = whitened(nuisances_);
  }

  Eigen::MatrixXd whitened(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd result = x;
    result.topRows(old_.rows()) = old_.matrixL().solve(x.topRows(old_.rows()));
    result.bottomRows(design_.error_sd.size()).array().colwise() /= design_.error_sd.array();
    return result;
  }

  /// Norm of what neither `hiding` (whitened columns) nor the nuisances within their priors can take from `difference`.
  double left(const Eigen::VectorXd& difference, const Eigen::MatrixXd& hiding) const {
    const Eigen::Index n = nuisances_.rows(), q = nuisances_.cols(), k = hiding.cols();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + q, q + k);
    A.topRows(n) << nuisances_, hiding;
    A.bottomLeftCorner(q, q).setIdentity();
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + q);
    b.head(n) = difference;
    return (b - A * A.colPivHouseholderQr().solve(b)).norm();
  }

 private:
  Eigen::LLT<Eigen::MatrixXd> old_;
  const Design& design_;
  Eigen::MatrixXd nuisances_;
};

double t_criterion(const Evidence& evidence, const Augmented& augmented, const Design& design, const Option& first,
                   const Option& second) {
  const Eigen::MatrixXd one = augmented.whitened(signatures(evidence, design, first.effects));
  const Eigen::MatrixXd other = augmented.whitened(signatures(evidence, design, second.effects));
  return std::min(augmented.left(one * first.parameters, other), augmented.left(other * second.parameters, one));
}

std::string words(const Evidence& evidence, const Option& option) {
  std::string result;
  for (const int effect : option.effects) result += (result.empty() ? "" : "+") + evidence.candidates[effect].effect;
  return result.empty() ? "none" : result;
}

}  // namespace

double t_criterion(const Evidence& evidence, const Covariance& covariance, const Design& design, const Option& first,
                   const Option& second) {
  return t_criterion(evidence, Augmented(evidence, covariance, design), design, first, second);
}

std::vector<NextMeasurement> next_measurements(const Evidence& evidence, const Covariance& covariance,
                                               const std::vector<Design>& designs, const AmbiguitySet& set) {
  std::vector<Option> options;
  for (const auto& alike : set.classes)
    for (const Option& option : alike)
      if (!option.has_unknown && options.size() < kLikeliest) options.push_back(option);
  std::vector<Augmented> augmented;
  for (const Design& design : designs) augmented.emplace_back(evidence, covariance, design);
  std::vector<NextMeasurement> result;
  for (std::size_t i = 0; i < options.size(); ++i)
    for (std::size_t j = i + 1; j < options.size(); ++j) {
      NextMeasurement best;
      double most = -1.0;
      for (std::size_t d = 0; d < designs.size(); ++d) {
        const double t = t_criterion(evidence, augmented[d], designs[d], options[i], options[j]);
        // Whatever settles it comes before what does not.
        const double worth = t >= kSettled ? 1e6 + t * t / designs[d].cost : t;
        if (worth <= most) continue;
        most = worth;
        best = {designs[d].name, {words(evidence, options[i]), words(evidence, options[j])}, t, designs[d].cost};
      }
      if (most >= 0.0) result.push_back(best);
    }
  return result;
}

}  // namespace fathom
