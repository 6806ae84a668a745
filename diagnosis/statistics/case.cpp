#include "diagnosis/statistics/case.h"

#include <algorithm>

#include "diagnosis/statistics/excess.h"

namespace fathom {

Case case_of(const Evidence& evidence, const Predict& predict, const DecisionSettings& settings) {
  Case c{evidence, predict, settings, estimate_covariance(evidence, measured_minus_predicted(evidence)), {}, {}, {},
         {},       {},      {}};
  c.problem = whitened_problem(evidence, c.covariance);
  c.shapes = gap_shapes(evidence, c.covariance);
  c.draws = gap_draws(c.shapes, pseudo_experiments(c.covariance, settings.pseudo_experiments, settings.seed));
  c.spaces = candidate_spaces(c.problem, c.covariance);
  c.discovery = discovery_tail(c.spaces, c.draws.all);
  c.gap = gap_test(c.shapes, c.problem.residual, c.draws, Eigen::MatrixXd(c.problem.residual.size(), 0));
  return c;
}

Rest rest_of(const Case& c, const Refit& fit) {
  Rest rest{c.problem.residual - fit.prediction, orthonormal(fit.jacobian), {}, c.gap.p};
  if (rest.explained.cols() > 0) {
    rest.residual -= rest.explained * (rest.explained.transpose() * rest.residual);
    rest.p = gap_test(c.shapes, rest.residual, c.draws, rest.explained).p;
  }
  // Two looks at the same rest share the rate of false alarms. What sessions differ by matters where it is many errors,
  // where a tenth of the rate costs nothing; other gaps are often just seen.
  constexpr double kOfExcess = 0.1;
  rest.p /= 1.0 - kOfExcess;
  rest.excess = excess_of(c.evidence, c.covariance, rest.residual, rest.explained, kOfExcess * c.settings.p_gap);
  for (const Excess& excess : rest.excess) rest.p = std::min(rest.p, excess.p / kOfExcess);
  rest.p = std::min(rest.p, 1.0);
  return rest;
}

}  // namespace fathom
