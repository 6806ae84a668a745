#include "diagnosis/statistics/problem.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

namespace {
constexpr double kExpectedEffects = 1.0;
constexpr double kPriorWidth = 3.0;  // typical departures
// The squared width of the normal that is as high as the Cauchy at the peak.
constexpr double kPeakWidth2 = 0.5 * std::numbers::pi * kPriorWidth * kPriorWidth;

std::vector<std::vector<int>> same_elsewhere(const std::vector<Candidate>& candidates) {
  std::vector<std::vector<int>> result(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const EffectName own = effect_name(candidates[i].effect);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const EffectName other = effect_name(candidates[k].effect);
      if (own.id == other.id && own.liquid.empty() != other.liquid.empty()) result[i].push_back(static_cast<int>(k));
    }
  }
  return result;
}

}  // namespace

Eigen::VectorXd measured_minus_predicted(const Evidence& evidence) {
  Eigen::VectorXd residual = -evidence.predicted;
  for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] += evidence.observations[i].value;
  return residual;
}

Problem whitened_problem(const Evidence& evidence, const Covariance& covariance) {
  Eigen::Index parameters = 0;
  double plausibility = 0.0;
  for (const Candidate& candidate : evidence.candidates) {
    parameters += candidate.sensitivity.cols();
    plausibility += candidate.plausibility;
  }
  Problem problem;
  Eigen::MatrixXd sensitivities(evidence.predicted.size(), parameters);
  problem.lower.resize(parameters);
  problem.upper.resize(parameters);
  Eigen::Index column = 0;
  for (const Candidate& candidate : evidence.candidates) {
    problem.columns.emplace_back();
    problem.log_odds.push_back(std::log(kExpectedEffects * candidate.plausibility / plausibility));
    for (const Parameter& parameter : candidate.parameters) {
      const bool is_bounded = parameter.lower < parameter.upper;
      const double infinity = std::numeric_limits<double>::infinity();
      problem.lower[column] = is_bounded ? (parameter.lower - parameter.nominal) / parameter.prior_scale : -infinity;
      problem.upper[column] = is_bounded ? (parameter.upper - parameter.nominal) / parameter.prior_scale : infinity;
      // Of what goes in steps there is one at least, where it alone is the effect.
      if (candidate.parameters.size() == 1 && problem.lower[column] == 0.0)
        problem.lower[column] = parameter.step / parameter.prior_scale;
      const auto k = static_cast<Eigen::Index>(problem.columns.back().size());
      sensitivities.col(column) = parameter.prior_scale * candidate.sensitivity.col(k);
      problem.columns.back().push_back(column++);
    }
  }
  for (const Candidate& candidate : evidence.candidates)
    problem.leeways.push_back(leeway_of(candidate.leeway.columns.cols() > 0
                                            ? covariance.whiten(candidate.leeway.columns)
                                            : Eigen::MatrixXd(candidate.sensitivity.rows(), 0),
                                        candidate.leeway.grow_from));
  problem.said_by = same_elsewhere(evidence.candidates);
  problem.residual = covariance.whiten(measured_minus_predicted(evidence));
  problem.sensitivities = covariance.whiten(sensitivities);
  return problem;
}

std::vector<Eigen::Index> columns_of(const Problem& problem, const std::vector<int>& effects) {
  std::vector<Eigen::Index> result;
  for (const int effect : effects)
    result.insert(result.end(), problem.columns[effect].begin(), problem.columns[effect].end());
  return result;
}

bool holds_any(const std::vector<int>& effects, const std::vector<int>& others) {
  return std::find_first_of(effects.begin(), effects.end(), others.begin(), others.end()) != effects.end();
}

bool is_said(const Problem& problem, const std::vector<int>& effects, int effect) {
  return std::find(effects.begin(), effects.end(), effect) != effects.end() ||
         holds_any(effects, problem.said_by[effect]);
}

int widest_leeway(const Problem& problem, const std::vector<int>& effects) {
  return *std::max_element(effects.begin(), effects.end(),
                           [&](int a, int b) { return problem.leeways[a].log_det < problem.leeways[b].log_det; });
}

Leeway leeway_beside(const Problem& problem, const std::vector<int>& effects, const Eigen::VectorXd& parameters) {
  Leeway widest;
  Eigen::Index first = 0;
  for (const int effect : effects) {
    const auto count = static_cast<Eigen::Index>(problem.columns[effect].size());
    if (!parameters.segment(first, count).isZero(0.0))
      if (Leeway own = problem.leeways[effect].at(parameters[first]); own.log_det > widest.log_det)
        widest = std::move(own);
    first += count;
  }
  return widest;
}

Hypothesis part_of(const Problem& problem, const Hypothesis& whole, const std::vector<std::size_t>& positions) {
  Hypothesis part;
  std::vector<Eigen::Index> own;  // places in the whole's parameters
  Eigen::Index column = 0;
  for (std::size_t e = 0; e < whole.effects.size(); ++e) {
    const bool is_in = std::find(positions.begin(), positions.end(), e) != positions.end();
    if (is_in) part.effects.push_back(whole.effects[e]);
    for (std::size_t k = 0; k < problem.columns[whole.effects[e]].size(); ++k, ++column)
      if (is_in) own.push_back(column);
  }
  part.parameters = whole.parameters(own);
  return part;
}

Hypothesis with_effect(const Problem& problem, const Hypothesis& part, int effect, const Eigen::VectorXd& parameters) {
  Hypothesis whole{part.effects, Eigen::VectorXd(part.parameters.size() + parameters.size())};
  const auto place = std::upper_bound(whole.effects.begin(), whole.effects.end(), effect);
  const auto before = static_cast<Eigen::Index>(columns_of(problem, {whole.effects.begin(), place}).size());
  whole.effects.insert(place, effect);
  whole.parameters << part.parameters.head(before), parameters, part.parameters.tail(part.parameters.size() - before);
  return whole;
}

double log_evidence(const Problem& problem, double gain, const std::vector<int>& effects,
                    const Eigen::VectorXd& parameters, const Eigen::MatrixXd& gram) {
  if (effects.empty()) return 0.0;
  const Eigen::MatrixXd widened = Eigen::MatrixXd::Identity(gram.rows(), gram.cols()) + kPeakWidth2 * gram;
  const double log_det = 2.0 * widened.llt().matrixLLT().diagonal().array().log().sum();
  double log_odds = 0.0;
  for (const int effect : effects) log_odds += problem.log_odds[effect];
  return 0.5 * (gain - prior_penalty(parameters) - log_det) + log_odds;
}

double parameter_cost(double information) { return std::log1p(kPeakWidth2 * information); }

double prior_penalty(const Eigen::VectorXd& parameters) {
  return 2.0 * (parameters.array() / kPriorWidth).square().log1p().sum();
}

Eigen::VectorXd prior_precisions(const Eigen::VectorXd& parameters) {
  return 2.0 / (kPriorWidth * kPriorWidth + parameters.array().square());
}

Eigen::MatrixXd without(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& directions) {
  return directions.cols() == 0 ? columns : columns - directions * (directions.transpose() * columns);
}

}  // namespace fathom
