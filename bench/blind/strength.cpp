#include "bench/blind/strength.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "bench/blind/laboratory.h"
#include "bench/blind/match.h"
#include "bench/blind/observe.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

constexpr std::uint64_t kStanding = 0x57e6;  // the same dots and grains for every signature
constexpr int kLooks = 4;
constexpr double kElsewhere = 10e-3;  // [m] a window: dots that fell into one fall into others
/// Nobody wrote down albedos: 1 σ of the logarithm of a cup's and of an opaque liquid's.
constexpr double kAlbedoSigma = 0.3;
constexpr double kNotSeen = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnseenSigma = 1e6;  // of a reading that is not there: it weighs nothing
/// Deviation of a frame's mean disparity: what the dots of a whole desk leave of their noise, and the device's own;
/// and of a region of the cup, of ten dots.
constexpr double kFrameSigmaPx = 0.005, kRegionSigmaPx = kTemporalDotPx / 3.2;

bool shows_in_spread(const Hidden& effect) { return effect.name == "depth_wander" || effect.name == "vibration"; }
/// Of frames' disparity without the effect. A wave along the rows leaves a frame's mean alone: it shows where regions
/// of the cup move against the desk, by 1/√2 of its amplitude.
double spread_sigma_px(const Hidden& effect) {
  return effect.name == "vibration" ? std::numbers::sqrt2 * kRegionSigmaPx : kFrameSigmaPx;
}
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

Eigen::MatrixXd Strengths::values(const Change& change, bool over_time) const {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(placements_.size()) * kReadings, kLooks);
  std::map<decltype(condition_of(placements_[0])), Eigen::MatrixXd> known;
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Placement& p = placements_[i];
    Eigen::MatrixXd& seen = known[condition_of(p)];
    if (seen.size() == 0 || over_time) {
      seen.resize(kReadings, kLooks);
      for (int look = 0; look < kLooks; ++look) {
        Placement there = p;
        Rng rng(kStanding, look);
        there.lateral += kElsewhere * (rng.uniform() - 0.5);
        there.distance += kElsewhere * (rng.uniform() - 0.5);
        World world = believed(there);
        change(world, there);
        const Readings readings = as_recorded(design_, observe(world, there, design_.trials, kStanding + look));
        for (int k = 0; k < kReadings; ++k) seen(k, look) = readings[k].sigma > 0.0 ? readings[k].value : kNotSeen;
      }
    }
    result.middleRows(static_cast<Eigen::Index>(i) * kReadings, kReadings) = seen;
  }
  return result;
}

Eigen::MatrixXd Strengths::difference(const Change& change, bool over_time) const {
  return (values(change, over_time) - nominal_).unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
}

Eigen::VectorXd Strengths::per_sigma(double sigma, const std::function<void(World&, double)>& add) const {
  constexpr double kStep = 4.0;  // of σ: dots that change windows are the less beside it
  return difference([&](World& world, const Placement&) { add(world, kStep * sigma); }).rowwise().mean() / kStep;
}

Eigen::VectorXd Strengths::brighter(bool of_milk) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(nominal_.rows());
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

Strengths::Strengths(const Design& design, std::vector<Placement> placements, double scale)
    : design_(design), placements_(std::move(placements)), scale_(scale) {
  nominal_ = values([](World&, const Placement&) {}, false);

  const auto moved = [&](int axis) {
    return per_sigma(scale_ * kPlacementSigma,
                     [axis](World& world, double metres) { world.cup.centre[axis] += metres; });
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
    columns.push_back(whitened(per_sigma(scale_ * value.sigma, value.add)));
  for (const Uncertain& value : dust()) columns.push_back(whitened(per_sigma(value.sigma, value.add)));
  for (const bool of_milk : {false, true}) columns.push_back(whitened(brighter(of_milk)));
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
  each(per_sigma(scale_ * kFillSigma,
                 [](World& world, double metres) {
                   if (world.fill > 0.0) world.fill += metres;
                 }),
       &Placement::pour);
  for (const SessionError& error : session_errors())
    each(per_sigma(scale_ * error.sigma, error.add), &Placement::session);

  Eigen::MatrixXd n(nominal_.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) n.col(static_cast<Eigen::Index>(i)) = columns[i];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(n.transpose() * n);
  const Eigen::VectorXd squares = gram.eigenvalues();
  const Eigen::Index kept = (squares.array() > 1e-9 * squares.maxCoeff()).count();
  nuisance_axes_ = n * gram.eigenvectors().rightCols(kept) * squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  nuisance_loss_ = 1.0 - (1.0 + squares.tail(kept).array()).sqrt().inverse();
}

Eigen::MatrixXd Strengths::signature(std::span<const Active> effects) const {
  const bool over_time =
      std::any_of(effects.begin(), effects.end(), [](const Active& active) { return shows_over_time(*active.effect); });
  const Eigen::MatrixXd change =
      whitened(difference([&](World& world, const Placement& p) { apply_all(world, p, effects); }, over_time));
  return change - nuisance_axes_ * nuisance_loss_.asDiagonal() * (nuisance_axes_.transpose() * change);
}

/// Of a variance that is wider by a known share: half the logarithm over its standard error 1/√(2 ν).
double Strengths::of_spread(const Active& active) const {
  if (!design_.clouds) return 0.0;
  const double repeats = static_cast<double>(placements_.size()) * (design_.trials - 1);
  const double ratio = active.departure / (scale_ * spread_sigma_px(*active.effect));
  return 0.5 * std::log1p(ratio * ratio) * std::sqrt(2.0 * repeats);
}

double Strengths::of(const Active& effect) const {
  if (shows_in_spread(*effect.effect)) return of_spread(effect);
  // Coarser steps leave means alone and show in every cloud at once.
  if (shows_in_steps(*effect.effect)) return design_.clouds ? 30.0 : 0.0;
  return common_norm(signature(std::span(&effect, 1)));
}

double Strengths::departure_for(const Hidden& effect, double s, double sign) const {
  const auto inside = [&](double departure) { return std::clamp(departure, effect.least, effect.most); };
  double departure =
      inside(std::copysign(effect.typical, effect.least < 0.0 && effect.most > 0.0 ? sign : effect.typical));
  if (shows_in_steps(effect)) return departure;
  if (shows_in_spread(effect)) {
    const double repeats = static_cast<double>(placements_.size()) * (design_.trials - 1);
    return inside(scale_ * spread_sigma_px(effect) * std::sqrt(std::expm1(2.0 * s / std::sqrt(2.0 * repeats))));
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

double Strengths::escape(const Eigen::MatrixXd& signature, std::span<const Hidden* const> registry) const {
  std::vector<Eigen::VectorXd> columns;
  for (const Hidden* effect : registry) {
    if (shows_in_spread(*effect) || shows_in_steps(*effect)) continue;
    const Active active{effect, effect->typical};
    const Eigen::MatrixXd looks = this->signature(std::span(&active, 1));
    if (common_norm(looks) > 0.1) columns.push_back(looks.rowwise().mean().normalized());
  }
  if (columns.empty()) return common_norm(signature);
  Eigen::MatrixXd span(signature.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) span.col(static_cast<Eigen::Index>(i)) = columns[i];
  return common_norm(signature - span * span.colPivHouseholderQr().solve(signature));
}

std::map<std::string, double> Strengths::by_liquid(const Eigen::MatrixXd& signature) const {
  std::map<std::string, std::vector<Eigen::Index>> rows;
  for (std::size_t i = 0; i < placements_.size(); ++i)
    for (int k = 0; k < kReadings; ++k)
      rows[placements_[i].liquid].push_back(static_cast<Eigen::Index>(i) * kReadings + k);
  std::map<std::string, double> norms;
  for (const auto& [liquid, own] : rows) norms[liquid] = common_norm(signature(own, Eigen::all));
  return norms;
}

}  // namespace fathom::blind
