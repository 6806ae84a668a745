#include "diagnosis/unit/bias_prior.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "diagnosis/unit/bias_learner.h"

namespace fathom {
namespace {

constexpr int kMostSteps = 24;
constexpr double kEnoughChange = 0.05;  ///< change of an amplitude, of the largest one's, at which the search ends
constexpr double kMost_px = 0.3, kNegligible_px = 0.002;
constexpr std::size_t kFewestViews = 3;
constexpr std::size_t kMostViews = 24;  ///< that are looked at, evenly: a covariance has few numbers
constexpr int kFewestStates = 3;        ///< of fewer nobody can say what is a state's own

/// From where the search starts: everything may be there but for the finest part, which ten times the time would seek.
BiasPrior wide_prior(int states) {
  BiasPrior prior{{0.0, 0.03, 0.1, 0.05}, {0.0, 0.015, 0.04, 0.03}, {}, 0.02, 0.01};
  if (states >= kFewestStates) prior.state_px = {0.0, 0.02, 0.03, 0.03};
  return prior;
}

/// How much larger a variance should be: what its part explains over what it should by chance (Wood & Fasiolo 2017).
double better(double variance, double explained, double by_chance) {
  constexpr double kMostChange = 4.0;
  return variance * std::clamp(explained / std::max(by_chance, 1e-300), 1.0 / kMostChange, kMostChange);
}

/// The largest change of an amplitude, in shares of the largest amplitude.
double change(const BiasPrior& before, const BiasPrior& after) {
  double largest = 0.0, most = 0.0;
  for (const auto amplitudes : {&BiasPrior::reference_px, &BiasPrior::camera_px, &BiasPrior::state_px})
    for (std::size_t i = 0; i < (after.*amplitudes).size(); ++i) {
      largest = std::max(largest, (after.*amplitudes)[i]);
      most = std::max(most, std::abs((after.*amplitudes)[i] - (before.*amplitudes)[i]));
    }
  return most / std::max(largest, 1e-9);
}

/// From a prior that weighs as `dof` independent waves of each part, or is no more than a start.
BiasPrior improved_until_still(std::span<const BiasView> views, const BiasPrior& start, double dof) {
  BiasPrior prior = start;
  for (int step = 0; step < kMostSteps; ++step) {
    const BiasPrior before = std::exchange(prior, BiasLearner(views, prior).improved(dof, start));
    if (change(before, prior) < kEnoughChange) break;
  }
  return prior;
}

}  // namespace

BiasPrior default_bias_prior() { return {{0.01, 0.02, 0.1, 0.0}, {}, {}, 0.02, 0.0}; }

BiasPrior learned_bias_prior(std::span<const BiasView> views) {
  if (views.size() < kFewestViews) return default_bias_prior();
  std::vector<BiasView> some;
  const std::size_t most = std::min(kMostViews, views.size());
  for (std::size_t i = 0; i < most; ++i) some.push_back(views[i * views.size() / most]);
  std::map<int, int> states;  // numbered anew: each costs the same whether a view has it or not
  for (BiasView& view : some)
    if (view.state != kNoState) view.state = states.emplace(view.state, static_cast<int>(states.size())).first->second;
  BiasPrior prior = improved_until_still(some, wide_prior(static_cast<int>(states.size())), 0.0);
  for (BiasAmplitudes* amplitudes : {&prior.reference_px, &prior.camera_px, &prior.state_px})
    for (double& amplitude : *amplitudes)
      if (amplitude < kNegligible_px) amplitude = 0.0;
  if (prior.columns_px < kNegligible_px) prior.columns_px = 0.0;
  return prior;
}

BiasPrior bias_prior_of(const BiasView& desk, const BiasPrior& thought) {
  constexpr double kDof = 5.0;  // as of errors of the prediction
  return improved_until_still({&desk, 1}, thought, kDof);
}

BiasPrior BiasLearner::improved(double dof, const BiasPrior& thought) const {
  const int half = cosines_.size(), first = has_reference_ ? 0 : half;
  const Eigen::Index shared = shared_variance_.size();
  const Solution solution = solve(errors_);
  BiasPrior result = prior_;
  double explained_by_parts = 0.0;  // of the observations' number

  // By each wave: explained, and by chance.
  const auto improve = [&](BiasAmplitudes& amplitudes, const BiasAmplitudes& beforehand,
                           const Eigen::ArrayXd& explained, const Eigen::ArrayXd& chance) {
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      const double variance = amplitudes[i] * amplitudes[i];
      if (variance == 0.0) continue;
      const Eigen::ArrayXd density = variance * cosines_.density(kBiasReaches_px[i]).array();
      const double waves = (density * chance).sum(), squares = (density * explained).sum();
      explained_by_parts += waves;
      const double expected = dof * beforehand[i] * beforehand[i] / variance;
      amplitudes[i] = std::min(std::sqrt(better(variance, squares + expected, waves + dof)), kMost_px);
    }
  };
  const Eigen::MatrixXd covariance = precision_.solve(Eigen::MatrixXd::Identity(shared, shared));
  const Eigen::ArrayXd explained = (solution.shared.array() / shared_variance_.array()).square();
  Eigen::VectorXd before(shared);
  const Eigen::MatrixXd planes = sums_.planes();
  if (has_reference_) before.head(half) = without_planes(shared_variance_.head(half), planes.topRows(half));
  if (has_camera_) before.tail(half) = without_planes(shared_variance_.tail(half), planes.bottomRows(half));
  const Eigen::ArrayXd chance = (before - covariance.diagonal()).array() / shared_variance_.array().square();
  if (has_reference_) improve(result.reference_px, thought.reference_px, explained.head(half), chance.head(half));
  if (has_camera_) improve(result.camera_px, thought.camera_px, explained.tail(half), chance.tail(half));
  if (has_states_) {
    Eigen::ArrayXd of_states = Eigen::ArrayXd::Zero(half), by_chance = Eigen::ArrayXd::Zero(half);
    for (int state = 0; state < states(); ++state) {
      const StateBlock& block = of_state_[state];
      const Eigen::MatrixXd known = block.precision.solve(block.cross.transpose());  // half × shared
      const Eigen::MatrixXd own = block.precision.solve(Eigen::MatrixXd::Identity(half, half));
      const Eigen::ArrayXd variance =
          own.diagonal().array() + (known * covariance).cwiseProduct(known).rowwise().sum().array();
      of_states += (solution.states[state].array() / state_variance_.array()).square();
      const Eigen::VectorXd without = without_planes(state_variance_, sums_.planes(state).bottomRows(half));
      by_chance += (without.array() - variance) / state_variance_.array().square();
    }
    improve(result.state_px, thought.state_px, of_states, by_chance);
  }

  double of_cells = 0.0, of_steps = 0.0, steps_by_chance = 0.0;
  for (std::size_t view = 0; view < sums_.views(); ++view) {
    Eigen::VectorXd factors = Eigen::VectorXd::Zero(2 * half);
    factors.segment(first, shared) = solution.shared;
    const int state = sums_.state_of(view);
    if (has_state(state)) factors.tail(half) += solution.states[state];
    const Eigen::VectorXd left = sums_.whitened(view, errors_[view] - sums_.field(view, factors));
    of_cells += (left.array().square() / sums_.weight(view).array()).sum();
    if (prior_.columns_px <= 0.0) continue;
    of_steps += (sums_.steps(view).transpose() * left).squaredNorm();
    const Eigen::MatrixXd seen = sums_.projected_steps(view);
    Eigen::MatrixXd of_shared = seen.middleRows(first, shared);
    steps_by_chance += sums_.whitened_steps(view).trace();
    if (has_state(state)) {
      const StateBlock& block = of_state_[state];
      const Eigen::MatrixXd white = block.precision.matrixL().solve(seen.bottomRows(half));
      steps_by_chance -= white.squaredNorm();
      of_shared -= block.cross * block.precision.matrixU().solve(white);
    }
    steps_by_chance -= precision_.matrixL().solve(of_shared).squaredNorm();
  }
  const double of_columns = prior_.columns_px * prior_.columns_px * steps_by_chance;
  constexpr double kOfPlane = 3.0;
  const double free = static_cast<double>(sums_.cells()) - kOfPlane * static_cast<double>(sums_.views());
  const double noise = prior_.cell_px * prior_.cell_px;
  result.cell_px = std::sqrt(better(noise, noise * of_cells, std::max(free - explained_by_parts - of_columns, 1.0)));
  if (prior_.columns_px > 0.0)
    result.columns_px = std::sqrt(better(prior_.columns_px * prior_.columns_px, of_steps, steps_by_chance));
  return result;
}

}  // namespace fathom
