#include "diagnosis/statistics/refit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/box_least_squares.h"

namespace fathom {

namespace {

constexpr int kSteps = 6;
constexpr double kEnough = 1e-3;      // of the squared norm, in units of its error: nothing that a test would see
constexpr double kDifference = 0.02;  // of a typical departure
constexpr double kNoAnswer = 1e-6;    // errors per typical departure: rounding
constexpr double kBent = 0.5;         // of a change, that the sensitivities say otherwise

/// Of parameters in prior scales, none larger than the prior's.
Eigen::VectorXd standard_errors(const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd precision = jacobian.transpose() * jacobian;
  precision.diagonal().array() += 1.0;
  return precision.inverse().diagonal().cwiseSqrt();
}

/// The model with some effects on, in whitened units.
class Model {
 public:
  Model(const Evidence& evidence, const Predict& predict, const Covariance& covariance, const Problem& problem,
        const std::vector<int>& effects)
      : evidence_(evidence),
        predict_(predict),
        covariance_(covariance),
        effects_(effects),
        lower_(problem.lower(columns_of(problem, effects))),
        upper_(problem.upper(columns_of(problem, effects))) {}

  /// The parameters' bounds.
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  Eigen::VectorXd change(const Eigen::VectorXd& parameters) const {
    std::vector<EffectValue> values;
    Eigen::Index next = 0;
    for (const int effect : effects_) {
      const Candidate& candidate = evidence_.candidates[effect];
      values.push_back({candidate.effect, {}});
      for (const Parameter& parameter : candidate.parameters)
        values.back().values.push_back(parameter.nominal + parameter.prior_scale * parameters[next++]);
    }
    return covariance_.whiten(predict_(values) - evidence_.predicted);
  }

  /// All values of a parameter that the model knows in whole multiples of a step only; none of other parameters.
  std::vector<double> steps_of(Eigen::Index k) const {
    std::vector<double> result;
    Eigen::Index next = 0;
    for (const int effect : effects_)
      for (const Parameter& parameter : evidence_.candidates[effect].parameters) {
        if (next++ != k || parameter.step == 0.0) continue;
        const double step = parameter.step / parameter.prior_scale;
        for (double value = lower_[k]; value < upper_[k] + 0.5 * step; value += step) result.push_back(value);
      }
    return result;
  }

  /// Over one standard error to either side, as `jacobian` has it: within that a gate that some pixel just passes is
  /// chance, not a slope. Neither beyond the bounds nor across where the parameter is absent: some effects change more
  /// by being there than by how much there is of them. What goes in steps answers to no small difference: its slope is
  /// the chord from where it is absent.
  Eigen::MatrixXd differences(const Eigen::VectorXd& at, const Eigen::VectorXd& change_at,
                              const Eigen::MatrixXd& jacobian) const {
    Eigen::MatrixXd slopes(change_at.size(), at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) slopes.col(k) = difference(k, at, change_at, jacobian);
    return slopes;
  }

  /// The same of one parameter.
  Eigen::VectorXd difference(Eigen::Index k, const Eigen::VectorXd& at, const Eigen::VectorXd& change_at,
                             const Eigen::MatrixXd& jacobian) const {
    const auto chord = [&] {
      Eigen::VectorXd absent = at;
      absent[k] = 0.0;
      return Eigen::VectorXd((change_at - change(absent)) / at[k]);
    };
    if (lower_[k] == upper_[k] && at[k] != 0.0) return chord();
    const double step = std::max(standard_errors(jacobian)[k], kDifference);
    double low = std::max(at[k] - step, lower_[k]), high = std::min(at[k] + step, upper_[k]);
    if (low <= 0.0 && at[k] > 0.0) low = at[k];
    if (high >= 0.0 && at[k] < 0.0) high = at[k];
    if (low == high) (low > lower_[k] ? low -= kDifference : high += kDifference);  // at a bound or next to absence
    Eigen::VectorXd moved = at;
    moved[k] = high;
    Eigen::VectorXd slope = high == at[k] ? change_at : change(moved);
    moved[k] = low;
    slope -= low == at[k] ? change_at : change(moved);
    slope /= high - low;
    return slope.norm() > kNoAnswer || at[k] == 0.0 ? slope : chord();
  }

 private:
  const Evidence& evidence_;
  const Predict& predict_;
  const Covariance& covariance_;
  std::vector<int> effects_;
  Eigen::VectorXd lower_, upper_;
};

/// Slopes do not know that some effects, such as foam, are all there as soon as there is any of them: a step towards
/// where an effect is absent ends shortly before, and only the next one may go there.
Eigen::VectorXd without_switching_off(const Eigen::VectorXd& from, Eigen::VectorXd move) {
  for (Eigen::Index k = 0; k < move.size(); ++k)
    if (move[k] == -from[k] && std::abs(from[k]) > kDifference) move[k] = std::copysign(kDifference, from[k]) - from[k];
  return move;
}

}  // namespace

Refit refit(const Evidence& evidence, const Predict& predict, const Covariance& covariance, const Problem& problem,
            const Hypothesis& start) {
  const Model model(evidence, predict, covariance, problem, start.effects);
  const std::vector<Eigen::Index> columns = columns_of(problem, start.effects);
  const auto objective = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& change) {
    const Leeway leeway = leeway_beside(problem, start.effects, x);
    return leeway.whiten(problem.residual - change).squaredNorm() + leeway.log_det + prior_penalty(x);
  };
  Eigen::MatrixXd jacobian = problem.sensitivities(Eigen::all, columns);
  Eigen::VectorXd x = start.parameters, change = model.change(x);
  double value = objective(x, change), damping = 0.0;
  // What changes nothing where its effect is absent, such as the time of a warm-up, may change something here.
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k)
    if (jacobian.col(k).isZero(0.0)) jacobian.col(k) = model.difference(k, x, change, jacobian);
  bool is_differenced = false;
  for (int step = 0; step < kSteps; ++step) {
    const Leeway leeway = leeway_beside(problem, start.effects, x);
    const Eigen::MatrixXd slopes = leeway.whiten(jacobian);
    Eigen::MatrixXd G = slopes.transpose() * slopes;
    const Eigen::VectorXd prior = prior_precisions(x);
    const Eigen::VectorXd b = slopes.transpose() * leeway.whiten(problem.residual - change) - prior.cwiseProduct(x);
    G.diagonal() = G.diagonal() * (1.0 + damping) + prior;
    const Eigen::VectorXd move =
        without_switching_off(x, box_least_squares(G, b, model.lower() - x, model.upper() - x));
    if (move.isZero(1e-9)) break;
    const Eigen::VectorXd next_change = model.change(x + move);
    const double next_value = objective(x + move, next_change);
    jacobian += ((next_change - change) - jacobian * move) * move.transpose() / move.squaredNorm();
    if (next_value < value) {
      const bool is_done = value - next_value < kEnough;
      x += move;
      change = next_change;
      value = next_value;
      damping *= 0.2;
      if (is_done) break;
    } else if (next_value - value < kEnough) {
      break;
    } else if (!is_differenced) {
      jacobian = model.differences(x, change, jacobian);
      is_differenced = true;
    } else {
      damping = std::max(4.0 * damping, 1e-2);
    }
  }
  // What goes in steps has no slopes that lead from one to the next.
  bool has_jumped = false;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (x[k] == 0.0) continue;
    for (const double other : model.steps_of(k)) {
      Eigen::VectorXd moved = x;
      moved[k] = other;
      Eigen::VectorXd moved_change = model.change(moved);
      const double moved_value = objective(moved, moved_change);
      if (moved_value >= value - kEnough) continue;
      x = moved;
      change = std::move(moved_change);
      value = moved_value;
      has_jumped = true;
    }
  }
  // What is there as a whole as soon as there is any of it answers to its amount otherwise than to its beginning.
  const Eigen::VectorXd straight = problem.sensitivities(Eigen::all, columns) * x;
  if (has_jumped || (change - straight).norm() > kBent * change.norm())
    jacobian = model.differences(x, change, jacobian);
  return weighed(problem, start.effects, x, std::move(change), std::move(jacobian));
}

Refit weighed(const Problem& problem, const std::vector<int>& effects, const Eigen::VectorXd& parameters,
              Eigen::VectorXd change, Eigen::MatrixXd jacobian) {
  const Leeway leeway = leeway_beside(problem, effects, parameters);
  const Eigen::MatrixXd slopes = leeway.whiten(jacobian);
  const Eigen::VectorXd left = problem.residual - change, rest = leeway.whiten(left);
  const double gain = problem.residual.squaredNorm() - rest.squaredNorm() - leeway.log_det;
  return {{effects, parameters, gain, log_evidence(problem, gain, effects, parameters, slopes.transpose() * slopes)},
          change + leeway.share_in(left),
          std::move(change),
          rest,
          std::move(jacobian)};
}

Refit with_differences(const Evidence& evidence, const Predict& predict, const Covariance& covariance,
                       const Problem& problem, Refit fit) {
  const Model model(evidence, predict, covariance, problem, fit.hypothesis.effects);
  fit.jacobian = model.differences(fit.hypothesis.parameters, fit.change, fit.jacobian);
  return fit;
}

}  // namespace fathom
