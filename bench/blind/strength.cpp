#include "bench/blind/strength.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "bench/blind/laboratory.h"
#include "bench/blind/observe.h"

namespace fathom::blind {
namespace {

constexpr std::uint64_t kStanding = 0x57e6;  // the same dots and grains for every signature
constexpr double kNotSeen = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnseenSigma = 1e6;  // of a reading that is not there: it weighs nothing
/// Deviation of a frame's mean disparity: what the dots of a whole desk leave of their noise, and the device's own.
constexpr double kFrameSigmaPx = 0.005;

bool shows_in_spread(const Hidden& effect) { return effect.name == "depth_wander" || effect.name == "vibration"; }
bool shows_over_time(const Hidden& effect) { return effect.name == "thermal_drift" || effect.name == "evaporation"; }
bool shows_in_steps(const Hidden& effect) { return effect.name == "depth_quantization"; }

auto condition_of(const Placement& p) { return std::tuple(p.liquid, p.fill, p.distance, p.lateral); }

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

Eigen::VectorXd Strengths::values(const Change& change, bool over_time) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(placements_.size()) * kReadings);
  std::map<decltype(condition_of(placements_[0])), Eigen::VectorXd> known;
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Placement& p = placements_[i];
    Eigen::VectorXd& seen = known[condition_of(p)];
    if (seen.size() == 0 || over_time) {
      World world = believed(p);
      change(world, p);
      const Readings readings = as_recorded(design_, observe(world, p, design_.trials, kStanding));
      seen.resize(kReadings);
      for (int k = 0; k < kReadings; ++k) seen[k] = readings[k].sigma > 0.0 ? readings[k].value : kNotSeen;
    }
    result.segment(static_cast<Eigen::Index>(i) * kReadings, kReadings) = seen;
  }
  return result;
}

Eigen::VectorXd Strengths::difference(const Change& change, bool over_time) const {
  return (values(change, over_time) - nominal_).unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
}

Eigen::VectorXd Strengths::whitened(const Eigen::VectorXd& difference) const {
  Eigen::VectorXd result(difference.size());
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Eigen::Index first = static_cast<Eigen::Index>(i) * kReadings;
    result.segment(first, kReadings) =
        block_root_[i].triangularView<Eigen::Lower>().solve(difference.segment(first, kReadings));
  }
  return result;
}

Strengths::Strengths(const Design& design, std::vector<Placement> placements, double scale)
    : design_(design), placements_(std::move(placements)), scale_(scale) {
  nominal_ = values([](World&, const Placement&) {}, false);

  const auto moved = [&](int axis) {
    return difference([&](World& world, const Placement&) { world.cup.centre[axis] += kPlacementSigma * scale_; });
  };
  const Eigen::VectorXd to_x = moved(0), to_y = moved(1);
  std::map<decltype(condition_of(placements_[0])), Readings> noise;
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Placement& p = placements_[i];
    if (!noise.contains(condition_of(p)))
      noise[condition_of(p)] = as_recorded(design_, observe(believed(p), p, design_.trials, kStanding));
    const Eigen::Index first = static_cast<Eigen::Index>(i) * kReadings;
    Eigen::MatrixXd covariance = to_x.segment(first, kReadings) * to_x.segment(first, kReadings).transpose() +
                                 to_y.segment(first, kReadings) * to_y.segment(first, kReadings).transpose();
    for (int k = 0; k < kReadings; ++k) {
      const double sigma = noise[condition_of(p)][k].sigma;
      covariance(k, k) += std::pow(sigma > 0.0 ? scale_ * sigma : kUnseenSigma, 2);
    }
    block_root_.push_back(covariance.llt().matrixL());
  }

  std::vector<Eigen::VectorXd> columns;
  for (const Uncertain& value : uncertain_rig())
    columns.push_back(
        whitened(difference([&](World& world, const Placement&) { value.add(world, value.sigma * scale_); })));
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
  each(difference([&](World& world, const Placement&) {
         if (world.fill > 0.0) world.fill += kFillSigma * scale_;
       }),
       &Placement::pour);
  for (const SessionError& error : session_errors())
    each(difference([&](World& world, const Placement&) { error.add(world, error.sigma * scale_); }),
         &Placement::session);

  Eigen::MatrixXd n(nominal_.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) n.col(static_cast<Eigen::Index>(i)) = columns[i];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(n.transpose() * n);
  const Eigen::VectorXd squares = gram.eigenvalues();
  const Eigen::Index kept = (squares.array() > 1e-9 * squares.maxCoeff()).count();
  nuisance_axes_ = n * gram.eigenvectors().rightCols(kept) * squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  nuisance_loss_ = 1.0 - (1.0 + squares.tail(kept).array()).sqrt().inverse();
}

Eigen::VectorXd Strengths::signature(std::span<const Active> effects) const {
  const bool over_time =
      std::any_of(effects.begin(), effects.end(), [](const Active& active) { return shows_over_time(*active.effect); });
  const Eigen::VectorXd change =
      whitened(difference([&](World& world, const Placement& p) { apply_all(world, p, effects); }, over_time));
  return change - nuisance_axes_ * nuisance_loss_.asDiagonal() * (nuisance_axes_.transpose() * change);
}

/// Of a variance that is wider by a known share: half the logarithm over its standard error 1/√(2 ν).
double Strengths::of_spread(const Active& active) const {
  if (!design_.clouds) return 0.0;
  const double repeats = static_cast<double>(placements_.size()) * (design_.trials - 1);
  const double ratio = active.departure / (scale_ * kFrameSigmaPx);
  return 0.5 * std::log1p(ratio * ratio) * std::sqrt(2.0 * repeats);
}

double Strengths::of(const Active& effect) const {
  if (shows_in_spread(*effect.effect)) return of_spread(effect);
  // Coarser steps leave means alone and show in every cloud at once.
  if (shows_in_steps(*effect.effect)) return design_.clouds ? 30.0 : 0.0;
  return signature(std::span(&effect, 1)).norm();
}

double Strengths::departure_for(const Hidden& effect, double s, double sign) const {
  const auto inside = [&](double departure) { return std::clamp(departure, effect.least, effect.most); };
  double departure =
      inside(std::copysign(effect.typical, effect.least < 0.0 && effect.most > 0.0 ? sign : effect.typical));
  if (shows_in_steps(effect)) return departure;
  if (shows_in_spread(effect)) {
    const double repeats = static_cast<double>(placements_.size()) * (design_.trials - 1);
    return inside(scale_ * kFrameSigmaPx * std::sqrt(std::expm1(2.0 * s / std::sqrt(2.0 * repeats))));
  }
  // Signatures are nearly straight lines.
  constexpr int kSteps = 6;
  constexpr double kNearEnough = 0.02;
  for (int i = 0; i < kSteps; ++i) {
    const double now = of({&effect, departure});
    if (now <= 0.0 || std::abs(now / s - 1.0) < kNearEnough) break;
    const double next = inside(departure * std::clamp(s / now, 0.02, 50.0));
    if (next == departure) break;
    departure = next;
  }
  return departure;
}

double Strengths::escape(const Eigen::VectorXd& signature, std::span<const Hidden* const> registry) const {
  std::vector<Eigen::VectorXd> columns;
  for (const Hidden* effect : registry) {
    if (shows_in_spread(*effect) || shows_in_steps(*effect)) continue;
    const Active active{effect, effect->typical};
    const Eigen::VectorXd column = this->signature(std::span(&active, 1));
    if (column.norm() > 0.1) columns.push_back(column.normalized());
  }
  if (columns.empty()) return signature.norm();
  Eigen::MatrixXd span(signature.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) span.col(static_cast<Eigen::Index>(i)) = columns[i];
  return (signature - span * span.colPivHouseholderQr().solve(signature)).norm();
}

std::map<std::string, double> Strengths::by_liquid(const Eigen::VectorXd& signature) const {
  std::map<std::string, double> squares;
  for (std::size_t i = 0; i < placements_.size(); ++i)
    squares[placements_[i].liquid] +=
        signature.segment(static_cast<Eigen::Index>(i) * kReadings, kReadings).squaredNorm();
  for (auto& [liquid, square] : squares) square = std::sqrt(square);
  return squares;
}

}  // namespace fathom::blind
