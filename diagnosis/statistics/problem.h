// Data and candidates in units of the errors: what selection, refit and decision work on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Parameters are departures from nominal in units of their prior scale.
struct Problem {
  Eigen::VectorXd residual;    ///< whitened, measured − predicted
  Eigen::MatrixXd signatures;  ///< whitened, n × parameters of all candidates
  Eigen::VectorXd lower, upper;
  std::vector<std::vector<Eigen::Index>> columns;  ///< of each candidate
};

Eigen::VectorXd measured_minus_predicted(const Evidence& evidence);

Problem whitened_problem(const Evidence& evidence, const Covariance& covariance);

/// The columns of several candidates, in their order.
std::vector<Eigen::Index> columns_of(const Problem& problem, const std::vector<int>& effects);

/// A set of effects that may be what the model lacks.
struct Hypothesis {
  std::vector<int> effects;    ///< ascending
  Eigen::VectorXd parameters;  ///< of them, one after the other
  double gain = 0.0;           ///< decrease of the residual's squared norm
  double log_evidence = 0.0;   ///< relative to no effect, with the prior of the set
};

/// Laplace's log evidence: normal priors three typical departures wide on every parameter, and half an effect expected
/// among all candidates. `jacobian` is whitened, n × parameters.
double log_evidence(const Problem& problem, double gain, const std::vector<int>& effects,
                    const Eigen::VectorXd& parameters, const Eigen::MatrixXd& gram);

/// Standard deviation of the priors, in typical departures.
inline constexpr double kPriorWidth = 3.0;

/// Orthonormal columns with the span of the given ones.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

}  // namespace fathom
