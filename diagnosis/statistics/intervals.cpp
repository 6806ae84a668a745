#include "diagnosis/statistics/intervals.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/distributions.h"

namespace fathom {

namespace {

/// Of the parameters in prior scales.
Eigen::MatrixXd parameter_covariance(const Choice& choice) {
  const Eigen::MatrixXd& J = choice.fit.jacobian;
  return (J.transpose() * J).completeOrthogonalDecomposition().pseudoInverse();
}

/// All that rounds to one value fits alike: a fit ends anywhere among them.
double whole(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

}  // namespace

std::vector<std::vector<double>> covariance_in_units(const Case& c, const Choice& choice) {
  std::vector<double> scales;
  for (const int effect : choice.fit.hypothesis.effects)
    for (const Parameter& parameter : c.evidence.candidates[effect].parameters) scales.push_back(parameter.prior_scale);
  const Eigen::MatrixXd covariance = parameter_covariance(choice);
  std::vector<std::vector<double>> rows(scales.size());
  for (std::size_t i = 0; i < scales.size(); ++i)
    for (std::size_t j = 0; j < scales.size(); ++j)
      rows[i].push_back(scales[i] * scales[j] * covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  return rows;
}

void add_parameters(const Case& c, Choice& choice) {
  const Eigen::MatrixXd covariance = parameter_covariance(choice);
  const std::vector<EffectSize> sizes =
      sizes_beside_others(c.problem, c.covariance, choice.fit.hypothesis, choice.fit.jacobian);
  Eigen::Index next = 0;
  for (std::size_t e = 0; e < choice.effects.size(); ++e)
    for (const Parameter& parameter : c.evidence.candidates[choice.fit.hypothesis.effects[e]].parameters) {
      const double fitted = parameter.nominal + parameter.prior_scale * choice.fit.hypothesis.parameters[next];
      const double value = whole(fitted, parameter.step);
      const double half =
          std::max(student_quantile(0.025, sizes[e].dof) * parameter.prior_scale * std::sqrt(covariance(next, next)),
                   0.5 * parameter.step);
      ++next;
      NamedParameter named{parameter.name, value, value - half, value + half};
      if (parameter.lower < parameter.upper) {
        named.low95 = std::max(named.low95, parameter.lower);
        named.high95 = std::min(named.high95, parameter.upper);
      }
      choice.effects[e].parameters.push_back(std::move(named));
    }
}

}  // namespace fathom
