#include "diagnosis/statistics/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/dense.h"
#include "core/parallel.h"
#include "diagnosis/statistics/box_least_squares.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

constexpr Eigen::Index kRank = 400;
constexpr double kEnoughVariance = 1e-3;  // of the process's variance may be left out
constexpr std::array<double, 8> kSizes{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0};  // times the errors

constexpr double kNarrowest_mm = 12.0;  // what is narrower, a matcher's window makes as wide: 9 px, 0.75 m away

struct Place {
  int observable, liquid, region;
  Eigen::Vector3d position;  ///< fill, distance, lateral over their ranges; of parts of the cup, in narrowest shapes
  double size;
};

/// 1 σ of a single observation beyond what nuisances make: mean of its observable.
Eigen::VectorXd typical_errors(const Evidence& evidence, const Covariance& covariance) {
  Eigen::VectorXd result(covariance.total.rows());
  const Eigen::VectorXd variances = covariance.total.diagonal() - covariance.nuisance.rowwise().squaredNorm();
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) result(rows).setConstant(std::sqrt(variances(rows).mean()));
  return result;
}

std::vector<Place> places(const Evidence& evidence, const Eigen::VectorXd& errors) {
  const auto& observations = evidence.observations;
  const Eigen::MatrixXd x = places_in_ranges(observations);
  const Groups observables = group_by(observations, [](const Observation& o) { return o.observable; });
  const Groups liquids =
      group_by(observations, [](const Observation& o) { return fmt::format("={}", level(o, "liquid")); });
  const Groups regions = group_by(
      observations, [&](const Observation& o) { return o.factors.within_mm ? std::string() : "=" + o.factors.region; });
  std::vector<Place> result;
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    Place place{observables.of[i], liquids.of[i], regions.of[i], {}, errors[i]};
    if (const auto& within_mm = observations[i].factors.within_mm)
      place.position << *within_mm / kNarrowest_mm, 0.0;
    else
      place.position = x.row(i);
    result.push_back(std::move(place));
  }
  return result;
}

double kernel(const Place& a, const Place& b, double shared) {
  if (a.observable != b.observable) return 0.0;
  const double same = (a.liquid == b.liquid ? 1.0 : shared) * (a.region == b.region ? 1.0 : shared);
  return a.size * b.size * same * std::exp(-0.5 * (a.position - b.position).squaredNorm());
}

Eigen::MatrixXd smooth_factor(const std::vector<Place>& at, double shared) {
  const auto n = static_cast<Eigen::Index>(at.size());
  const auto column = [&](Eigen::Index other) {
    return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index i) { return kernel(at[i], at[other], shared); }).eval();
  };
  const Eigen::VectorXd variances =
      Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index i) { return kernel(at[i], at[i], shared); });
  return pivoted_cholesky(variances, column, kEnoughVariance * variances, kRank);
}

/// A smooth shape of what is seen in cups, half of it in all liquids: what it does to every observation that is of
/// parts of the cup. Its standard deviation is one error of a part.
Eigen::MatrixXd shape_factor(const std::vector<Observation>& observations, const Eigen::VectorXd& errors) {
  const Groups liquids = group_by(observations, [](const Observation& o) { return "=" + o.factors.liquid; });
  std::map<std::tuple<int, double, double>, std::size_t> numbers;
  std::vector<Place> points;
  const auto number_of = [&](std::size_t row, const SeenPart& part) {
    const int liquid = liquids.of[row];
    const auto [known, is_new] = numbers.try_emplace({liquid, part.at_mm.x(), part.at_mm.y()}, points.size());
    if (is_new)
      points.push_back({0, liquid, 0, {part.at_mm.x() / kNarrowest_mm, part.at_mm.y() / kNarrowest_mm, 0.0}, 1.0});
    return static_cast<Eigen::Index>(known->second);
  };
  double size = 0.0, count = 0.0;
  for (std::size_t row = 0; row < observations.size(); ++row) {
    for (const SeenPart& part : observations[row].parts) number_of(row, part);
    if (observations[row].factors.within_mm) size += errors[static_cast<Eigen::Index>(row)], ++count;
  }
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(errors.size(), 0);
  if (count == 0.0) return factor;
  const Eigen::MatrixXd of_points = size / count * smooth_factor(points, 0.5);
  factor.setZero(errors.size(), of_points.cols());
  for (std::size_t row = 0; row < observations.size(); ++row)
    for (const SeenPart& part : observations[row].parts)
      factor.row(static_cast<Eigen::Index>(row)) += part.weight * of_points.row(number_of(row, part));
  return factor;
}

/// A process of some columns at one size beside effects, with the variances taken to be what they are said to be; and
/// what both leave.
Beside beside(const Spectrum& columns, double size, const LinearEffects& effects, Eigen::Ref<Eigen::VectorXd> rest) {
  const Eigen::VectorXd y = columns.whiten(size, effects.response);
  const Eigen::MatrixXd J = columns.whiten(size, effects.jacobian);
  Beside result;
  result.gram = J.transpose() * J;
  result.parameters = effects.parameters;
  rest = y;
  if (J.cols() > 0) {
    Eigen::MatrixXd with_prior = result.gram;
    with_prior.diagonal() += prior_precisions(effects.parameters);
    result.parameters = box_least_squares(with_prior, J.transpose() * y, effects.lower, effects.upper);
    rest -= J * result.parameters;
  }
  result.gain = y.squaredNorm() - rest.squaredNorm();
  result.log_likelihood = 0.5 * (effects.response.squaredNorm() - y.squaredNorm()) - columns.half_log_det(size);
  return result;
}

/// z² of a residual along each column.
Eigen::ArrayXd squared_scores(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residual) {
  const Eigen::ArrayXd squares = columns.colwise().squaredNorm().transpose();
  return (columns.transpose() * residual).array().square() / squares.max(1e-12);
}

/// The process and size that a residual makes likeliest.
struct Likeliest {
  const Spectrum* process = nullptr;
  double size = 0.0, log_evidence = -INFINITY;
};

/// `stratum`: of the clearest one, which has to live as long.
Likeliest likeliest_of(const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                       std::optional<Spectrum>& stratum) {
  Likeliest best;
  const auto consider = [&](const Spectrum& process) {
    for (const double size : kSizes)
      if (const double evidence = process.log_evidence(size, residual); evidence > best.log_evidence)
        best = {&process, size, evidence};
  };
  consider(discrepancy.of_smooth);
  consider(discrepancy.of_apart);
  if (!discrepancy.of_shape.is_empty()) consider(discrepancy.of_shape);
  const Eigen::ArrayXd z2 = squared_scores(discrepancy.strata, residual);
  if (Eigen::Index clearest = 0; z2.size() > 0) {
    z2.maxCoeff(&clearest);
    consider(stratum.emplace(discrepancy.strata.col(clearest)));
  }
  return best;
}

}  // namespace

Spectrum::Spectrum(const Eigen::MatrixXd& columns) {
  constexpr double kNothing = 1e-9;
  if (columns.cols() == 0) return;  // no decomposition is one of nothing
  const SymmetricEigen eigen = symmetric_eigen(columns.transpose() * columns);
  const Eigen::Index count = (eigen.values.array() > kNothing).count();
  values_ = eigen.values.tail(count);
  to_weights_ = eigen.vectors.rightCols(count) * values_.rsqrt().matrix().asDiagonal();
  along_ = columns * to_weights_;
}

double Spectrum::half_log_det(double size) const { return 0.5 * (1.0 + size * size * values_).log().sum(); }

Eigen::MatrixXd Spectrum::whiten(double size, const Eigen::MatrixXd& x) const {
  const Eigen::VectorXd less = 1.0 - (1.0 + size * size * values_).rsqrt();
  return x - along_ * (less.asDiagonal() * (along_.transpose() * x));
}

Eigen::VectorXd Spectrum::weights(double size, const Eigen::VectorXd& residual) const {
  return to_weights_ * (share(size) * (along_.transpose() * residual).array()).matrix();
}

double Spectrum::log_evidence(double size, const Eigen::VectorXd& residual) const {
  return 0.5 * (share(size) * (along_.transpose() * residual).array().square()).sum() - half_log_det(size);
}

Discrepancy discrepancy_of(const Evidence& evidence, const std::vector<Stratum>& strata, const Covariance& covariance) {
  const Eigen::VectorXd errors = typical_errors(evidence, covariance);
  const std::vector<Place> at = places(evidence, errors);
  Eigen::MatrixXd smooth_factor_of_all = smooth_factor(at, 0.5);
  Eigen::MatrixXd smooth = covariance.whiten(smooth_factor_of_all);
  std::vector<const Stratum*> main;
  for (const Stratum& stratum : strata)
    if (stratum.is_main) main.push_back(&stratum);
  Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(errors.size(), static_cast<Eigen::Index>(main.size()));
  for (std::size_t k = 0; k < main.size(); ++k)
    for (const Eigen::Index row : main[k]->rows) shifts(row, static_cast<Eigen::Index>(k)) = errors[row];
  std::array<Spectrum, 3> spectra;
  parallel_items(static_cast<int>(spectra.size()), [&](int i) {
    if (i == 0) spectra[i] = Spectrum(smooth);
    if (i == 1) spectra[i] = Spectrum(covariance.whiten(smooth_factor(at, 0.0)));
    if (i == 2) spectra[i] = Spectrum(covariance.whiten(shape_factor(evidence.observations, errors)));
  });
  return {std::move(smooth_factor_of_all), std::move(smooth),     std::move(spectra[0]),
          std::move(spectra[1]),           std::move(spectra[2]), covariance.whiten(shifts)};
}

std::vector<std::pair<double, Beside>> beside(const Discrepancy& discrepancy, const VarianceProfile& variances,
                                              const LinearEffects& effects) {
  constexpr std::size_t kLikeliest = 6;  // strata: these stand for all
  std::vector<std::pair<double, Beside>> result;
  Eigen::MatrixXd rests(effects.response.size(), static_cast<Eigen::Index>((3 + kLikeliest) * kSizes.size()));
  const auto add = [&](const Spectrum& spectrum, double weight) {
    for (const double size : kSizes) {
      const auto next = static_cast<Eigen::Index>(result.size());
      result.emplace_back(std::log(weight / static_cast<double>(kSizes.size())),
                          beside(spectrum, size, effects, rests.col(next)));
    }
  };
  const bool has_shapes = !discrepancy.of_shape.is_empty();
  const double each = 0.5 / (has_shapes ? 3.0 : 2.0);
  add(discrepancy.of_smooth, each);
  add(discrepancy.of_apart, each);
  if (has_shapes) add(discrepancy.of_shape, each);
  const Eigen::MatrixXd explained = orthonormal(effects.jacobian);
  const Eigen::MatrixXd strata = without(discrepancy.strata, explained);
  const Eigen::ArrayXd z2 = squared_scores(strata, effects.response);
  std::vector<Eigen::Index> order(strata.cols());
  std::iota(order.begin(), order.end(), 0);
  const auto few = order.begin() + static_cast<std::ptrdiff_t>(std::min(kLikeliest, order.size()));
  std::partial_sort(order.begin(), few, order.end(), [&](auto a, auto b) { return z2[a] > z2[b]; });
  for (auto k = order.begin(); k != few; ++k)
    add(Spectrum(discrepancy.strata.col(*k)), 0.5 / static_cast<double>(order.size()));
  const Eigen::VectorXd log_factors = variances.log_factors(rests.leftCols(static_cast<Eigen::Index>(result.size())));
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i].second.log_likelihood += log_factors[static_cast<Eigen::Index>(i)];
  return result;
}

Eigen::MatrixXd whiten_beside(const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& x) {
  std::optional<Spectrum> stratum;
  const Likeliest likeliest = likeliest_of(discrepancy, residual, stratum);
  return likeliest.process->whiten(likeliest.size, x);
}

bool is_shape(const Discrepancy& discrepancy, const Eigen::VectorXd& residual) {
  std::optional<Spectrum> stratum;
  return likeliest_of(discrepancy, residual, stratum).process == &discrepancy.of_shape;
}

Eigen::VectorXd smooth_map(const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                           const Eigen::MatrixXd& explained) {
  const Spectrum spectrum(without(discrepancy.smooth, explained));
  const Eigen::VectorXd left = without(residual, explained);
  const double best = *std::max_element(kSizes.begin(), kSizes.end(), [&](double a, double b) {
    return spectrum.log_evidence(a, left) < spectrum.log_evidence(b, left);
  });
  return discrepancy.smooth_factor * spectrum.weights(best, left);
}

}  // namespace fathom
