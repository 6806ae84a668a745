#include "diagnosis/unit/bias_learner.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "core/dense.h"
#include "core/error.h"

namespace fathom {
namespace {

constexpr double kNone = 1e-14;           ///< [px²] variance of a factor that is not there; keeps precisions finite
constexpr double kNoPlane = 1e-3;         ///< [px] the field's own plane over what was seen is zero within this
constexpr std::size_t kMostPoints = 600;  ///< among which patterns of error are looked for
constexpr double kEnoughVariance = 1e-6;  ///< of the largest among them

bool any(const BiasAmplitudes& amplitudes) {
  return std::ranges::any_of(amplitudes, [](double amplitude) { return amplitude > 0.0; });
}

/// Wave number [1/px] beyond which the parts hold nothing that matters: a part's variance beyond k is
/// amplitude² exp(−k² reach² / 2). Cosines are level at the borders, where wide fields are not: these need finer waves
/// than their own.
double finest_wave(const BiasPrior& prior) {
  constexpr double kNothing_px = 0.003;  // what rounding to whole millimetres leaves in a cell
  double finest = 0.08;
  for (const auto amplitudes : {&BiasPrior::reference_px, &BiasPrior::camera_px, &BiasPrior::state_px})
    for (std::size_t i = 0; i < kBiasReaches_px.size(); ++i)
      if (const double size = (prior.*amplitudes)[i] / kNothing_px; size > 1.0)
        finest = std::max(finest, 2.0 * std::sqrt(std::log(size)) / kBiasReaches_px[i]);
  return std::min(finest, kMostWave_per_px);
}

Eigen::VectorXd variance_of(const Cosines& cosines, const BiasAmplitudes& amplitudes) {
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(cosines.size(), kNone);
  for (std::size_t i = 0; i < amplitudes.size(); ++i)
    variance += amplitudes[i] * amplitudes[i] * cosines.density(kBiasReaches_px[i]);
  return variance;
}

void forbid_planes(const Eigen::MatrixXd& planes, Eigen::MatrixXd& precision) {
  precision.noalias() += planes * planes.transpose() / (kNoPlane * kNoPlane);
}

void require_definite(const Eigen::LLT<Eigen::MatrixXd>& precision) {
  if (precision.info() != Eigen::Success)
    throw Error("these desks do not settle a unit's bias: the normal equations are singular");
}

}  // namespace

Eigen::VectorXd BiasLearner::without_planes(const Eigen::VectorXd& variance, const Eigen::MatrixXd& planes) {
  const Eigen::MatrixXd shared = variance.asDiagonal() * planes;
  Eigen::MatrixXd of_planes = planes.transpose() * shared;
  of_planes.diagonal().array() += kNoPlane * kNoPlane;
  return variance - shared.cwiseProduct(shared * of_planes.inverse()).rowwise().sum();
}

BiasLearner::BiasLearner(std::span<const BiasView> layout, const BiasPrior& prior)
    : cosines_(finest_wave(prior)),
      prior_(prior),
      sums_(cosines_, layout, prior),
      has_reference_(any(prior.reference_px) || !any(prior.camera_px)),
      has_camera_(any(prior.camera_px)),
      has_states_(any(prior.state_px)) {
  for (const BiasView& view : layout)
    errors_.push_back(
        Eigen::Map<const Eigen::VectorXd>(view.errors_px.data(), static_cast<Eigen::Index>(view.errors_px.size())));
  const int half = cosines_.size(), shared = half * (has_reference_ + has_camera_);
  const int first = has_reference_ ? 0 : half;
  const Eigen::VectorXd reference = variance_of(cosines_, prior.reference_px),
                        camera = variance_of(cosines_, prior.camera_px);
  shared_variance_.resize(2 * half);
  shared_variance_ << reference, camera;
  shared_variance_ = shared_variance_.segment(first, shared).eval();
  state_variance_ = variance_of(cosines_, prior.state_px);

  Eigen::MatrixXd precision = shared_variance_.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd planes = sums_.planes();
  if (has_reference_) {
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(shared, planes.cols());
    own.topRows(half) = planes.topRows(half);
    forbid_planes(own, precision);
  }
  if (has_camera_) {
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(shared, planes.cols());
    own.bottomRows(half) = planes.bottomRows(half);
    forbid_planes(own, precision);
  }
  for (int state = kNoState; state < sums_.states(); ++state) {
    if (!has_states_) {
      precision += sums_.gram(state, first, shared);
      if (state != kNoState) of_state_.emplace_back();
      continue;
    }
    const Eigen::MatrixXd gram = sums_.gram(state, 0, 2 * half);
    precision += gram.block(first, first, shared, shared);
    if (state == kNoState) continue;
    StateBlock& block = of_state_.emplace_back();
    Eigen::MatrixXd own = gram.bottomRightCorner(half, half);
    own.diagonal() += state_variance_.cwiseInverse();
    forbid_planes(sums_.planes(state).bottomRows(half), own);
    block.precision.compute(own);
    require_definite(block.precision);
    block.cross = gram.block(first, half, shared, half);
    const Eigen::MatrixXd known = block.precision.matrixL().solve(block.cross.transpose());
    precision.selfadjointView<Eigen::Lower>().rankUpdate(known.transpose(), -1.0);
    precision = precision.selfadjointView<Eigen::Lower>();
  }
  precision_.compute(precision);
  require_definite(precision_);
}

BiasLearner::Solution BiasLearner::solve(std::span<const Eigen::VectorXd> errors_px) const {
  assert(errors_px.size() == sums_.views());
  const int half = cosines_.size(), first = has_reference_ ? 0 : half;
  const Eigen::Index shared = shared_variance_.size();
  Solution solution;
  solution.shared = Eigen::VectorXd::Zero(shared);
  solution.states.assign(of_state_.size(), Eigen::VectorXd::Zero(half));
  for (std::size_t view = 0; view < sums_.views(); ++view) {
    const Eigen::VectorXd seen = sums_.projected(view, sums_.whitened(view, errors_px[view]));
    solution.shared += seen.segment(first, shared);
    if (has_state(sums_.state_of(view))) solution.states[sums_.state_of(view)] += seen.tail(half);
  }
  if (has_states_)
    for (std::size_t i = 0; i < of_state_.size(); ++i)
      solution.shared -= of_state_[i].cross * of_state_[i].precision.solve(solution.states[i]);
  solution.shared = precision_.solve(solution.shared);
  if (has_states_)
    for (std::size_t i = 0; i < of_state_.size(); ++i)
      solution.states[i] =
          of_state_[i].precision.solve(solution.states[i] - of_state_[i].cross.transpose() * solution.shared);
  return solution;
}

BiasFactors BiasLearner::factors_of(const Solution& solution) const {
  BiasFactors factors;
  const int half = cosines_.size();
  if (has_reference_) factors.reference = solution.shared.head(half);
  if (has_camera_) factors.camera = solution.shared.tail(half);
  if (has_states_) factors.states = solution.states;
  return factors;
}

BiasField BiasLearner::learn(std::span<const Eigen::VectorXd> errors_px) const {
  return {cosines_, factors_of(solve(errors_px))};
}

BiasField BiasLearner::learn() const { return learn(errors_); }

std::vector<Eigen::VectorXd> BiasLearner::weighted(std::span<const Eigen::VectorXd> errors_px) const {
  assert(!has_states_);
  const int half = cosines_.size();
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(2 * half);
  factors.segment(has_reference_ ? 0 : half, shared_variance_.size()) = solve(errors_px).shared;
  std::vector<Eigen::VectorXd> result;
  for (std::size_t view = 0; view < errors_px.size(); ++view)
    result.push_back(sums_.whitened(view, errors_px[view] - sums_.field(view, factors)));
  return result;
}

Eigen::VectorXd BiasLearner::shared_at(const BiasPoint& point) const {
  const int half = cosines_.size();
  Eigen::VectorXd values(shared_variance_.size());
  const double column = point.pixel_px.x(), row = point.pixel_px.y();
  if (has_reference_) values.head(half) = cosines_.at(column - point.nearer_px, row);
  if (has_camera_) values.tail(half) = cosines_.at(column, row);
  return values;
}

Eigen::MatrixXd BiasLearner::whitened(std::span<const BiasPoint> points) const {
  const int half = cosines_.size();
  const Eigen::Index shared = shared_variance_.size();
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Zero(shared + (has_states_ ? half * states() : 0), static_cast<Eigen::Index>(points.size()));
  std::map<int, std::vector<Eigen::Index>> of_states;
  for (std::size_t i = 0; i < points.size(); ++i) {
    values.col(static_cast<Eigen::Index>(i)).head(shared) = shared_at(points[i]);
    if (has_state(points[i].state)) of_states[points[i].state].push_back(static_cast<Eigen::Index>(i));
  }
  for (const auto& [state, columns] : of_states) {
    const StateBlock& block = of_state_[state];
    Eigen::MatrixXd own(half, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Eigen::Vector2d& pixel_px = points[columns[i]].pixel_px;
      own.col(static_cast<Eigen::Index>(i)) = cosines_.at(pixel_px.x(), pixel_px.y());
    }
    block.precision.matrixL().solveInPlace(own);
    values(Eigen::seqN(shared + half * state, half), columns) = own;
    values(Eigen::seqN(0, shared), columns) -= block.cross * block.precision.matrixU().solve(own);
  }
  values.topRows(shared) = precision_.matrixL().solve(values.topRows(shared));
  return values;
}

double BiasLearner::sigma(const BiasPoint& point) const {
  double variance = whitened({&point, 1}).squaredNorm();
  if (has_states_ && !has_state(point.state))
    for (const double amplitude : prior_.state_px) variance += amplitude * amplitude;
  return std::sqrt(variance);
}

std::vector<BiasField> BiasLearner::error_modes(int count, std::span<const BiasPoint> where) const {
  std::vector<BiasPoint> some;
  const std::size_t every = std::max<std::size_t>(1, (where.size() + kMostPoints - 1) / kMostPoints);
  for (std::size_t i = 0; i < where.size(); i += every) some.push_back(where[i]);
  if (some.empty()) return {};
  const Eigen::MatrixXd points = whitened(some);
  const Eigen::VectorXd variances = points.colwise().squaredNorm();
  const Eigen::MatrixXd factor = pivoted_cholesky(
      variances, [&](Eigen::Index i) -> Eigen::VectorXd { return points.transpose() * points.col(i); },
      Eigen::VectorXd::Constant(variances.size(), kEnoughVariance * variances.maxCoeff()), variances.size());
  const SymmetricEigen eigen = symmetric_eigen(factor.transpose() * factor);
  const int half = cosines_.size();
  const Eigen::Index shared = shared_variance_.size();
  std::vector<BiasField> modes;
  for (Eigen::Index i = factor.cols() - 1; i >= 0 && static_cast<int>(modes.size()) < count; --i) {
    // Of the points' covariance the pattern is factor · vector / √value, of their white numbers as much again.
    const Eigen::VectorXd white = points * (factor * eigen.vectors.col(i)) / eigen.values[i];
    Solution mode;
    mode.shared = precision_.matrixU().solve(white.head(shared));
    if (has_states_)
      for (int state = 0; state < states(); ++state) {
        const StateBlock& block = of_state_[state];
        mode.states.push_back(block.precision.matrixU().solve(white.segment(shared + half * state, half)) -
                              block.precision.solve(block.cross.transpose() * mode.shared));
      }
    modes.emplace_back(cosines_, factors_of(mode));
  }
  return modes;
}

}  // namespace fathom
