#include "diagnosis/decision/intervals.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/dense.h"
#include "diagnosis/decision/held_out.h"
#include "diagnosis/statistics/distributions.h"

namespace fathom {

namespace {

/// Of the parameters in prior scales, beside the effects' leeway; what nothing shows is as uncertain as beforehand.
Eigen::MatrixXd parameter_covariance(const Problem& problem, const Refit& fit) {
  const Hypothesis& h = fit.hypothesis;
  const Eigen::MatrixXd slopes = leeway_beside(problem, h.effects, h.parameters).whiten(fit.jacobian);
  Eigen::MatrixXd precision = slopes.transpose() * slopes;
  const Eigen::VectorXd prior = prior_precisions(h.parameters);
  for (Eigen::Index k = 0; k < precision.rows(); ++k)
    if (precision(k, k) < prior[k]) precision(k, k) += prior[k];
  return pseudo_inverse(precision);
}

/// How well a fit's parameters are known.
struct Known {
  Eigen::MatrixXd covariance;  ///< in prior scales
  Eigen::VectorXd dofs;
};

Known how_known(const Case& c, const Refit& fit) {
  Eigen::MatrixXd covariance = parameter_covariance(c.problem, fit);
  // Columns dual to the parameters: each estimate's weights on the data.
  Eigen::VectorXd dofs = degrees_of_freedom(c.covariance, fit.jacobian * covariance);
  return {std::move(covariance), std::move(dofs)};
}

/// All that rounds to one value fits alike: a fit ends anywhere among them.
double whole(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

std::vector<std::vector<NamedParameter>> parameters_of(const Case& c, const Refit& fit, const Known& known) {
  std::vector<std::vector<NamedParameter>> result;
  Eigen::Index next = 0;
  for (const int effect : fit.hypothesis.effects) {
    const Candidate& candidate = c.evidence.candidates[effect];
    const double dof = known.dofs.segment(next, static_cast<Eigen::Index>(candidate.parameters.size())).minCoeff();
    result.emplace_back();
    for (const Parameter& parameter : candidate.parameters) {
      const double fitted = parameter.nominal + parameter.prior_scale * fit.hypothesis.parameters[next];
      const double value = whole(fitted, parameter.step);
      const double half =
          std::max(student_quantile(0.025, dof) * parameter.prior_scale * std::sqrt(known.covariance(next, next)),
                   0.5 * parameter.step);
      ++next;
      NamedParameter one{parameter.name, value, value - half, value + half};
      if (parameter.lower < parameter.upper) {
        one.low95 = std::max(one.low95, parameter.lower);
        one.high95 = std::min(one.high95, parameter.upper);
      }
      result.back().push_back(std::move(one));
    }
  }
  return result;
}

/// p of one effect's departures beside the others': χ² by the degrees of freedom of its variance.
double p_of(const Eigen::VectorXd& departures, const Eigen::MatrixXd& covariance, double dof) {
  const double chi2 = departures.dot(pseudo_inverse(covariance) * departures);
  const double z = departures.size() == 1
                       ? std::sqrt(std::max(0.0, chi2))
                       : normal_quantile(0.5 * chi_squared_tail(chi2, static_cast<double>(departures.size())));
  return 2.0 * normal_tail(normal_score(std::max(0.0, z), dof));
}

}  // namespace

std::vector<std::vector<double>> covariance_in_units(const Case& c, const Refit& fit) {
  std::vector<double> scales;
  for (const int effect : fit.hypothesis.effects)
    for (const Parameter& parameter : c.evidence.candidates[effect].parameters) scales.push_back(parameter.prior_scale);
  const Eigen::MatrixXd covariance = parameter_covariance(c.problem, fit);
  std::vector<std::vector<double>> rows(scales.size());
  for (std::size_t i = 0; i < scales.size(); ++i)
    for (std::size_t j = 0; j < scales.size(); ++j)
      rows[i].push_back(scales[i] * scales[j] * covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  return rows;
}

std::vector<std::vector<NamedParameter>> fitted_parameters(const Case& c, const Refit& fit) {
  return parameters_of(c, fit, how_known(c, fit));
}

std::vector<NamedEffect> named_effects(const Case& c, const Refit& fit) {
  const Known known = how_known(c, fit);
  std::vector<std::vector<NamedParameter>> parameters = parameters_of(c, fit, known);
  const std::vector<double> confirmed =
      confirmations(linear_fit(c.covariance, c.problem, fit), deal_folds(c.evidence.observations, c.settings.seed));
  std::vector<NamedEffect> result;
  Eigen::Index next = 0;
  for (const int effect : fit.hypothesis.effects) {
    const Candidate& candidate = c.evidence.candidates[effect];
    const auto count = static_cast<Eigen::Index>(candidate.parameters.size());
    const double dof = known.dofs.segment(next, count).minCoeff();
    NamedEffect named;
    named.name = candidate.effect;
    named.p_discovery = std::min(1.0, static_cast<double>(c.evidence.candidates.size()) *
                                          p_of(fit.hypothesis.parameters.segment(next, count),
                                               known.covariance.block(next, next, count, count), dof));
    named.p_confirmation =
        normal_tail(std::copysign(normal_score(confirmed[result.size()], dof), confirmed[result.size()]));
    named.parameters = std::move(parameters[result.size()]);
    next += count;
    result.push_back(std::move(named));
  }
  return result;
}

}  // namespace fathom
