#include "blind/strength.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "blind/block_mean.h"
#include "blind/unit.h"
#include "core/dense.h"
#include "core/estimate.h"

namespace fathom::blind {
namespace {

/// Nobody wrote down albedos: 1 σ of the logarithm of a cup's and of an opaque liquid's.
constexpr double kAlbedoSigma = 0.3;
constexpr double kUnseenSigma = 1e6;   // of a reading that is not there: it weighs nothing
constexpr double kScatterSigma = 0.2;  // of the logarithm of a device's scatter: nobody knows it better
/// Deviation of a frame's mean disparity: what the dots of a whole desk leave of their noise, and the device's own;
/// and of a region of the cup, of ten dots.
constexpr double kFrameSigmaPx = 0.005, kRegionSigmaPx = kTemporalDotPx / 3.2;

/// Of frames' disparity without the effect. A wave along the rows leaves a frame's mean alone: it shows where regions
/// of the cup move against the desk, by 1/√2 of its amplitude.
double spread_sigma_px(const Hidden& effect) {
  return effect.name == "vibration" ? std::numbers::sqrt2 * kRegionSigmaPx : kFrameSigmaPx;
}

/// A table of mean heights holds one reading, in the place of the first.
Readings as_recorded(const Design& design, Readings readings) {
  if (!design.infrared) readings[kBrightness] = readings[kBrightness + 1] = {};
  if (design.clouds) return readings;
  Reading mean{};
  int seen = 0;
  for (int i = 0; i < kRegions; ++i)
    if (readings[i].sigma > 0.0) {
      mean.value += readings[i].value;
      mean.sigma = std::hypot(mean.sigma, readings[i].sigma);
      ++seen;
    }
  readings = {};
  if (seen > 0) readings[0] = {mean.value / seen, mean.sigma / seen};
  return readings;
}

}  // namespace

const ConditionViews& Strengths::seen_from(std::size_t placement) const {
  return views_.at(condition_of(placements_[placement]));
}

template <class ViewOf>
Eigen::MatrixXd Strengths::difference_of_views(const ViewOf& view_of) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(placements_.size()) * kReadings, kLooks);
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const View& changed = view_of(i);
    for (int look = 0; look < kLooks; ++look) {
      const Readings now = as_recorded(design_, changed[look]);
      const Readings before = as_recorded(design_, seen_from(i).believed[look]);
      for (int k = 0; k < kReadings; ++k)
        if (now[k].sigma > 0.0 && before[k].sigma > 0.0)
          result(static_cast<Eigen::Index>(i) * kReadings + k, look) = now[k].value - before[k].value;
    }
  }
  return result;
}

Eigen::MatrixXd Strengths::difference(std::span<const Active> effects) const {
  if (effects.size() == 1 && effects[0].departure == effects[0].effect->typical &&
      !differs_by_placement(*effects[0].effect))
    return difference_of_views(
        [&](std::size_t i) -> const View& { return seen_from(i).typical.at(effects[0].effect->name); });
  const auto any = [&](bool (*shows)(const Hidden&)) {
    return std::any_of(effects.begin(), effects.end(), [&](const Active& active) { return shows(*active.effect); });
  };
  const bool over_time = any(shows_over_time), by_session = any(shows_by_session);
  std::map<std::pair<Condition, int>, View> known;
  return difference_of_views([&](std::size_t i) -> const View& {
    const auto [seen, is_new] =
        known.try_emplace({condition_of(placements_[i]), by_session ? placements_[i].session : 0});
    if (is_new || over_time)
      seen->second = view(placements_[i], [&](World& world, const Placement& p) { apply_all(world, p, effects); });
    return seen->second;
  });
}

Eigen::VectorXd Strengths::brighter(bool of_milk) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(placements_.size()) * kReadings);
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    if (!placements_[i].has_cup()) continue;
    const Eigen::Index inside = static_cast<Eigen::Index>(i) * kReadings + kBrightness;
    if ((placements_[i].liquid == "milk_tea") == of_milk) result[inside] = kAlbedoSigma;
    if (!of_milk) result[inside + 1] = kAlbedoSigma;  // the wall
  }
  return result;
}

Eigen::MatrixXd Strengths::whitened(const Eigen::MatrixXd& difference) const {
  Eigen::MatrixXd result(difference.rows(), difference.cols());
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Eigen::Index first = static_cast<Eigen::Index>(i) * kReadings;
    result.middleRows(first, kReadings) =
        block_root_[i].triangularView<Eigen::Lower>().solve(difference.middleRows(first, kReadings));
  }
  return result;
}

double Strengths::common_norm(const Eigen::MatrixXd& looks) {
  const auto n = static_cast<double>(looks.cols());
  const double between = (looks.rowwise().sum().squaredNorm() - looks.squaredNorm()) / (n * (n - 1.0));
  return std::sqrt(std::max(0.0, between));
}

std::vector<Eigen::VectorXd> Strengths::of_dots() const {
  std::map<Condition, std::vector<std::size_t>> conditions;
  for (std::size_t i = 0; i < placements_.size(); ++i)
    if (placements_[i].has_cup()) conditions[condition_of(placements_[i])].push_back(i);
  std::array<double, kReadings> squares{}, dof{};
  for (const auto& [condition, members] : conditions)
    for (int k = 0; k < kReadings; ++k) {
      Mean looks;
      for (const Readings& look : views_.at(condition).believed)
        if (const Reading reading = as_recorded(design_, look)[k]; reading.sigma > 0.0) looks.add(reading.value);
      if (looks.count() < 2) continue;
      const auto n = static_cast<double>(looks.count());
      squares[k] += n * (n - 1.0) * std::pow(looks.estimate().standard_error, 2);
      dof[k] += n - 1.0;
    }
  std::vector<Eigen::VectorXd> columns;
  for (const auto& [condition, members] : conditions)
    for (int k = 0; k < kReadings; ++k) {
      if (dof[k] == 0.0) continue;
      Eigen::VectorXd column = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(placements_.size()) * kReadings);
      for (const std::size_t i : members)
        column[static_cast<Eigen::Index>(i) * kReadings + k] = std::sqrt(squares[k] / dof[k]);
      columns.push_back(std::move(column));
    }
  return columns;
}

void Strengths::set_covariances(const std::vector<Eigen::VectorXd>& shared_by_placement) {
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Readings noise = as_recorded(design_, seen_from(i).noise.at(design_.trials));
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kReadings, kReadings);
    for (const Eigen::VectorXd& change : shared_by_placement) {
      const auto own = change.segment(static_cast<Eigen::Index>(i) * kReadings, kReadings);
      covariance += own * own.transpose();
    }
    for (int k = 0; k < kReadings; ++k)
      covariance(k, k) += std::pow(noise[k].sigma > 0.0 ? noise[k].sigma : kUnseenSigma, 2);
    block_root_.push_back(covariance.llt().matrixL());
  }
}

Strengths::Strengths(const Design& design, std::vector<Placement> placements, const Views& views)
    : design_(design), placements_(std::move(placements)), views_(views) {
  std::map<Shared, std::vector<Eigen::VectorXd>> changes;  // per 1 σ, in the mean over looks
  for (std::size_t n = 0; n < nuisances().size(); ++n)
    changes[nuisances()[n].shared].push_back(
        difference_of_views([&](std::size_t i) -> const View& { return seen_from(i).nuisances[n]; }).rowwise().mean() /
        kNuisanceSigmas);
  // A table of heights shows no desk from which the unit's bias could be learned.
  const double left_of_unit = design_.clouds ? kLeftOfUnit : 1.0;
  for (int wave = 0; wave < kUnitWaves; ++wave)
    changes[Shared::by_all].push_back(
        left_of_unit / kNuisanceSigmas *
        difference_of_views([&](std::size_t i) -> const View& { return seen_from(i).unit[wave]; }).rowwise().mean());
  for (const bool of_milk : {false, true}) changes[Shared::by_all].push_back(brighter(of_milk));
  set_covariances(changes[Shared::by_placement]);

  std::vector<Eigen::VectorXd> columns;
  for (const Eigen::VectorXd& change : changes[Shared::by_all]) columns.push_back(whitened(change));
  for (const Eigen::VectorXd& change : of_dots()) columns.push_back(whitened(change));
  // A pour is filled a little wrongly, a session set up a little otherwise: each explains its own placements only.
  const auto each = [&](const Eigen::VectorXd& change, int Placement::*group) {
    int last = 0;
    for (const Placement& p : placements_) last = std::max(last, p.*group);
    for (int number = 0; number <= last; ++number) {
      Eigen::VectorXd part = Eigen::VectorXd::Zero(change.size());
      for (std::size_t i = 0; i < placements_.size(); ++i)
        if (placements_[i].*group == number && (placements_[i].has_cup() || group == &Placement::session))
          part.segment(static_cast<Eigen::Index>(i) * kReadings, kReadings) =
              change.segment(static_cast<Eigen::Index>(i) * kReadings, kReadings);
      columns.push_back(whitened(part));
    }
  };
  for (const Eigen::VectorXd& change : changes[Shared::by_pour]) each(change, &Placement::pour);
  for (const Eigen::VectorXd& change : changes[Shared::by_session]) each(change, &Placement::session);

  Eigen::MatrixXd n(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) n.col(static_cast<Eigen::Index>(i)) = columns[i];
  const SymmetricEigen gram = symmetric_eigen(n.transpose() * n);
  const Eigen::VectorXd squares = gram.values;
  const Eigen::Index kept = (squares.array() > 1e-9 * squares.maxCoeff()).count();
  nuisance_axes_ = n * gram.vectors.rightCols(kept) * squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  nuisance_loss_ = 1.0 - (1.0 + squares.tail(kept).array()).sqrt().inverse();
}

Eigen::MatrixXd Strengths::sensitivity(std::span<const Active> effects) const {
  std::vector<Active> in_means;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(in_means),
               [](const Active& active) { return shows_in_means(*active.effect); });
  if (in_means.empty()) return Eigen::MatrixXd::Zero(nuisance_axes_.rows(), kLooks);
  const Eigen::MatrixXd change = whitened(difference(in_means));
  return change - nuisance_axes_ * nuisance_loss_.asDiagonal() * (nuisance_axes_.transpose() * change);
}

double Strengths::scatter_error() const { return std::hypot(1.0 / std::sqrt(2.0 * repeats()), kScatterSigma); }

double Strengths::repeats() const { return static_cast<double>(placements_.size()) * (design_.trials - 1); }

/// Of a variance that is wider by a known share: half the logarithm over the error of that, 1/√(2 ν) and what nobody
/// knows of the device.
double Strengths::of_spread(const Active& active) const {
  if (!design_.clouds) return 0.0;
  const double ratio = active.departure / spread_sigma_px(*active.effect);
  return 0.5 * std::log1p(ratio * ratio) / scatter_error();
}

Shown Strengths::shown(const Active& active) const {
  Shown shown{active, 0.0, sensitivity(std::span(&active, 1))};
  if (shows_in_spread(*active.effect))
    shown.s = of_spread(active);
  else if (shows_in_steps(*active.effect))
    shown.s = design_.clouds ? 30.0 : 0.0;  // coarser steps leave means alone and show in every cloud at once
  else
    shown.s = common_norm(shown.sensitivity);
  return shown;
}

Shown Strengths::sized(const Hidden& effect, double s, double sign) const {
  const auto inside = [&](double departure) { return std::clamp(departure, effect.least, effect.most); };
  if (shows_in_spread(effect))
    return shown({&effect, inside(spread_sigma_px(effect) * std::sqrt(std::expm1(2.0 * s * scatter_error())))});
  const double first = effect.least < 0.0 && effect.most > 0.0 ? std::copysign(effect.typical, sign) : effect.typical;
  Shown now = shown({&effect, inside(first)});
  if (shows_in_steps(effect)) return now;
  // Sensitivities are nearly straight lines.
  constexpr int kSteps = 6;
  constexpr double kNearEnough = 0.02;
  for (int i = 0; i < kSteps && now.s > 0.0 && std::abs(now.s / s - 1.0) >= kNearEnough; ++i) {
    const double next = inside(now.active.departure * std::clamp(s / now.s, 0.02, 50.0));
    if (next == now.active.departure) break;
    now = shown({&effect, next});
  }
  return now;
}

double Strengths::escape(const Eigen::MatrixXd& sensitivity, std::span<const Hidden* const> registry) const {
  std::vector<Eigen::VectorXd> columns;
  for (const Hidden* effect : registry) {
    const Shown typical = shown({effect, effect->typical});
    if (common_norm(typical.sensitivity) > 0.1) columns.push_back(typical.sensitivity.rowwise().mean().normalized());
  }
  if (columns.empty()) return common_norm(sensitivity);
  Eigen::MatrixXd span(sensitivity.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) span.col(static_cast<Eigen::Index>(i)) = columns[i];
  return common_norm(sensitivity - span * least_squares(span, sensitivity));
}

std::map<std::string, double> Strengths::by_liquid(const Eigen::MatrixXd& sensitivity) const {
  std::map<std::string, std::vector<Eigen::Index>> rows;
  for (std::size_t i = 0; i < placements_.size(); ++i)
    for (int k = 0; k < kReadings; ++k)
      rows[placements_[i].liquid].push_back(static_cast<Eigen::Index>(i) * kReadings + k);
  std::map<std::string, double> norms;
  for (const auto& [liquid, own] : rows) norms[liquid] = common_norm(sensitivity(own, Eigen::all));
  return norms;
}

}  // namespace fathom::blind
