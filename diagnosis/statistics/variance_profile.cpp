#include "diagnosis/statistics/variance_profile.h"

#include <cmath>
#include <utility>

#include "core/dense.h"
#include "core/parallel.h"
#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/shared_errors.h"

namespace fathom {

namespace {

constexpr double kLeastShare = 1e-4;
constexpr int kFirst = -4, kLast = 14;  // halves of powers of e: a from 0.14 to 1100

/// A component of which nothing was found may be as large as its uncertainty. `of_variance` is its estimate's.
double possible_variance(const VarianceComponent& component, double of_variance) {
  return component.variance > 0.0 ? component.variance : std::sqrt(std::max(0.0, of_variance));
}

/// How well the variance of a component is known. Of what was found (Satterthwaite 1946) no better than the model's
/// errors: a laboratory's pours differ between liquids and places, as devices do.
double dof_of(const VarianceComponent& component, double variance, double of_variance) {
  if (component.level == ErrorLevel::model) return kModelDof;
  if (component.level == ErrorLevel::session || component.variance < component.found.value) return kStatedDof;
  return of_variance > 0.0 ? std::min(2.0 * variance * variance / of_variance, kModelDof) : 0.0;
}

/// The log likelihood of a projection z whose share of the variance is a times as large, less that of a = 1:
/// of_squares · z² + constants.
Eigen::ArrayXd of_squares(double a, const Eigen::ArrayXd& shares) { return 0.5 - 0.5 / (1.0 + (a - 1.0) * shares); }
Eigen::ArrayXd constants(double a, const Eigen::ArrayXd& shares) { return -0.5 * (1.0 + (a - 1.0) * shares).log(); }

}  // namespace

std::optional<VarianceProfile::Part> VarianceProfile::part_of(const Eigen::MatrixXd& columns, double prior_dof,
                                                              double most) {
  const SymmetricEigen eigen = symmetric_eigen(columns.transpose() * columns);
  const Eigen::Index count = (eigen.values.array() > kLeastShare).count();
  std::vector<double> times;
  for (int k = kFirst; k <= kLast && std::exp(0.5 * k) <= most; ++k) times.push_back(std::exp(0.5 * k));
  if (count == 0 || times.empty()) return std::nullopt;
  const Eigen::VectorXd values = eigen.values.tail(count);
  const Eigen::ArrayXd shares = values.array().min(1.0);
  Part part{columns * eigen.vectors.rightCols(count) * values.cwiseSqrt().cwiseInverse().asDiagonal(),
            Eigen::MatrixXd(times.size(), count), Eigen::VectorXd(times.size())};
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double a = times[k];
    const auto row = static_cast<Eigen::Index>(k);
    part.of_squares.row(row) = of_squares(a, shares).matrix();
    part.constants[row] = constants(a, shares).sum() - 0.5 * prior_dof * (std::log(a) + 1.0 / a - 1.0);
  }
  return part;
}

VarianceProfile::VarianceProfile(const Covariance& covariance) {
  std::vector<std::pair<const ObservableErrors*, Eigen::Index>> components;
  for (const ObservableErrors& errors : covariance.errors.observables)
    for (std::size_t k = 0; k < errors.components.size(); ++k)
      components.emplace_back(&errors, static_cast<Eigen::Index>(k));
  std::vector<std::optional<Part>> parts(components.size());
  std::vector<Eigen::MatrixXd> singles(components.size(), Eigen::MatrixXd(covariance.total.rows(), 0));
  parallel_items(static_cast<int>(components.size()), [&](int i) {
    const auto [errors, k] = components[i];
    const VarianceComponent& component = errors->components[k];
    const double of_variance = errors->covariance(k, k);
    const double variance = possible_variance(component, of_variance);
    Eigen::MatrixXd columns = covariance.whiten(std::sqrt(variance) * columns_of(component));
    // An outlier that makes single observations' errors look large is weighed for itself.
    if (component.level != ErrorLevel::observation)
      parts[i] = part_of(columns, dof_of(component, variance, of_variance),
                         (component.level == ErrorLevel::model ? 1.0 : kMostOfKnown) * component.most / variance);
    if (component.level != ErrorLevel::model && component.level != ErrorLevel::session) singles[i] = std::move(columns);
  });
  if (covariance.nuisance.cols() > 0)
    parts.push_back(part_of(covariance.whiten(covariance.nuisance), kStatedDof, kMostOfKnown));
  for (std::optional<Part>& part : parts)
    if (part) parts_.push_back(*std::move(part));
  Eigen::Index count = 0;
  for (const Eigen::MatrixXd& columns : singles) count += columns.cols();
  single_directions_.resize(covariance.total.rows(), count);
  Eigen::Index next = 0;
  for (const Eigen::MatrixXd& columns : singles) {
    single_directions_.middleCols(next, columns.cols()) = columns;
    next += columns.cols();
  }
  const Eigen::ArrayXd squares = single_directions_.colwise().squaredNorm().transpose().array();
  single_directions_ *= squares.max(1e-300).rsqrt().matrix().asDiagonal();
  const Eigen::ArrayXd shares = squares.min(1.0);
  single_of_squares_.resize(count, kLast);
  single_constants_.resize(count, kLast);
  for (int k = 1; k <= kLast; ++k) {
    single_of_squares_.col(k - 1) = of_squares(std::exp(0.5 * k), shares);
    single_constants_.col(k - 1) = constants(std::exp(0.5 * k), shares);
  }
}

Eigen::VectorXd VarianceProfile::log_factors(const Eigen::MatrixXd& residuals) const {
  const bool has_singles = single_directions_.cols() > 0;
  // Of each residual the cases: nothing is wrong, one of the parts, a single group.
  std::vector<std::vector<double>> cases(static_cast<std::size_t>(residuals.cols()), {0.0});
  for (const Part& part : parts_) {
    const Eigen::MatrixXd squares = (part.directions.transpose() * residuals).cwiseAbs2();
    const Eigen::MatrixXd logs = (part.of_squares * squares).colwise() + part.constants;
    const double count = static_cast<double>(logs.rows()) * static_cast<double>(parts_.size());
    for (Eigen::Index i = 0; i < logs.cols(); ++i)
      cases[i].push_back(log_sum({logs.col(i).begin(), logs.col(i).end()}) - std::log(count));
  }
  if (has_singles) {
    const Eigen::ArrayXXd squares = (single_directions_.transpose() * residuals).cwiseAbs2();
    for (Eigen::Index i = 0; i < squares.cols(); ++i) {
      const Eigen::ArrayXXd logs = (single_of_squares_.colwise() * squares.col(i)) + single_constants_;
      const double most = logs.maxCoeff();
      cases[i].push_back(most + std::log((logs - most).exp().mean()));
    }
  }
  Eigen::VectorXd result(residuals.cols());
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = log_sum(cases[i]) - std::log(has_singles ? 3.0 : 2.0);
  return result;
}

}  // namespace fathom
