// Data and candidates in units of the errors: what selection, refit and decision work on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/leeway.h"

namespace fathom {

/// Parameters are departures from nominal in units of their prior scale.
struct Problem {
  Eigen::VectorXd residual;       ///< whitened, measured − predicted
  Eigen::MatrixXd sensitivities;  ///< whitened, n × parameters of all candidates
  Eigen::VectorXd lower, upper;
  std::vector<std::vector<Eigen::Index>> columns;  ///< of each candidate
  std::vector<double> log_odds;                    ///< of each candidate, before anything is measured
  std::vector<Leeway> leeways;                     ///< of each candidate
  /// Of each candidate, for "id" every "id@liquid", and the reverse. No set holds both.
  std::vector<std::vector<int>> said_by;
};

Eigen::VectorXd measured_minus_predicted(const Evidence& evidence);

Problem whitened_problem(const Evidence& evidence, const Covariance& covariance);

/// The columns of several candidates, in their order.
std::vector<Eigen::Index> columns_of(const Problem& problem, const std::vector<int>& effects);

/// Whether any of some effects is one of others.
bool holds_any(const std::vector<int>& effects, const std::vector<int>& others);

/// Whether an effect beside others is one of them, or the same in fewer liquids or more.
bool is_said(const Problem& problem, const std::vector<int>& effects, int effect);

/// The effect with the widest leeway, of at least one. A set gets the widest leeway of its effects, not their sum.
int widest_leeway(const Problem& problem, const std::vector<int>& effects);

/// The widest leeway among effects whose parameters are not all 0, each at its size.
Leeway leeway_beside(const Problem& problem, const std::vector<int>& effects, const Eigen::VectorXd& parameters);

/// A set of effects that may be what the model lacks.
struct Hypothesis {
  std::vector<int> effects;    ///< ascending
  Eigen::VectorXd parameters;  ///< of them, one after the other
  double gain = 0.0;  ///< decrease of −2 log likelihood: of the residual's squared norm, less its leeway's cost
  double log_evidence = 0.0;  ///< relative to no effect, with the prior of the set
};

/// Some effects of a hypothesis, by their position in it (ascending), where they are: without gain or evidence.
Hypothesis part_of(const Problem& problem, const Hypothesis& whole, const std::vector<std::size_t>& positions);

/// The hypothesis with one effect more, at these parameters: without gain or evidence.
Hypothesis with_effect(const Problem& problem, const Hypothesis& part, int effect, const Eigen::VectorXd& parameters);

/// Laplace's log evidence: the parameters' prior below, and one effect expected among all candidates, shared out by
/// their plausibility. `gram`: parameters × parameters, of the whitened jacobian.
double log_evidence(const Problem& problem, double gain, const std::vector<int>& effects,
                    const Eigen::VectorXd& parameters, const Eigen::MatrixXd& gram);

/// What Laplace's integral takes off for one parameter, −2 log: log(1 + w² information), w the width of the normal that
/// is as high as the prior at its peak; `information` is the data's, per squared prior scale.
double parameter_cost(double information);

/// −2 log of the prior density, from its peak: Cauchy, three typical departures wide, for each parameter. What is
/// typical is a guess; under a normal prior an effect would count against itself the more, the larger it clearly is
/// (Jeffreys 1961, Theory of Probability, section 5.2).
double prior_penalty(const Eigen::VectorXd& parameters);

/// Of the normal priors, about 0, that pull the parameters as the Cauchy does where they are.
Eigen::VectorXd prior_precisions(const Eigen::VectorXd& parameters);

/// What orthonormal directions (may be none) leave of columns.
Eigen::MatrixXd without(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& directions);

}  // namespace fathom
