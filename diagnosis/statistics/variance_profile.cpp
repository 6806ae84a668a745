#include "diagnosis/statistics/variance_profile.h"

#include <cmath>

#include "core/dense.h"
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

}  // namespace

void VarianceProfile::add(const Eigen::MatrixXd& columns, double prior_dof, double most) {
  const SymmetricEigen eigen = symmetric_eigen(columns.transpose() * columns);
  const Eigen::Index count = (eigen.values.array() > kLeastShare).count();
  if (count == 0 || most < std::exp(0.5 * kFirst)) return;
  const Eigen::VectorXd shares = eigen.values.tail(count);
  parts_.push_back({columns * eigen.vectors.rightCols(count) * shares.cwiseSqrt().cwiseInverse().asDiagonal(),
                    shares.array().min(1.0), prior_dof, most});
}

VarianceProfile::VarianceProfile(const Covariance& covariance) {
  std::vector<Eigen::MatrixXd> singles;
  Eigen::Index count = 0;
  for (const ObservableErrors& errors : covariance.errors.observables)
    for (std::size_t k = 0; k < errors.components.size(); ++k) {
      const VarianceComponent& component = errors.components[k];
      const auto row = static_cast<Eigen::Index>(k);
      const double of_variance = errors.covariance(row, row);
      const double variance = possible_variance(component, of_variance);
      const Eigen::MatrixXd columns = covariance.whiten(std::sqrt(variance) * columns_of(component));
      // An outlier that makes single observations' errors look large is weighed for itself.
      if (component.level != ErrorLevel::observation)
        add(columns, dof_of(component, variance, of_variance),
            (component.level == ErrorLevel::model ? 1.0 : kMostOfKnown) * component.most / variance);
      if (component.level == ErrorLevel::model || component.level == ErrorLevel::session) continue;
      singles.push_back(columns);
      count += columns.cols();
    }
  if (covariance.nuisance.cols() > 0) add(covariance.whiten(covariance.nuisance), kStatedDof, kMostOfKnown);
  single_directions_.resize(covariance.total.rows(), count);
  Eigen::Index next = 0;
  for (const Eigen::MatrixXd& columns : singles) {
    single_directions_.middleCols(next, columns.cols()) = columns;
    next += columns.cols();
  }
  const Eigen::ArrayXd squares = single_directions_.colwise().squaredNorm().transpose().array();
  single_shares_ = squares.min(1.0);
  single_directions_ *= squares.max(1e-300).rsqrt().matrix().asDiagonal();
}

double VarianceProfile::log_factor(const Eigen::VectorXd& residual) const {
  std::vector<double> all{0.0};  // nothing is wrong
  for (const Part& part : parts_) {
    const Eigen::ArrayXd squares = (part.directions.transpose() * residual).array().square();
    std::vector<double> logs;
    for (int k = kFirst; k <= kLast && std::exp(0.5 * k) <= part.most; ++k) {
      const double a = std::exp(0.5 * k);
      const Eigen::ArrayXd wider = 1.0 + (a - 1.0) * part.shares;
      logs.push_back(-0.5 * (wider.log() + squares / wider - squares).sum() -
                     0.5 * part.prior_dof * (std::log(a) + 1.0 / a - 1.0));
    }
    all.push_back(log_sum(logs) - std::log(static_cast<double>(logs.size() * parts_.size())));
  }
  if (single_shares_.size() > 0) {
    const Eigen::ArrayXd squares = (single_directions_.transpose() * residual).array().square();
    Eigen::ArrayXXd logs(single_shares_.size(), kLast);
    for (int k = 1; k <= kLast; ++k) {
      const Eigen::ArrayXd wider = 1.0 + (std::exp(0.5 * k) - 1.0) * single_shares_;
      logs.col(k - 1) = -0.5 * (wider.log() + squares / wider - squares);
    }
    const double most = logs.maxCoeff();
    all.push_back(most + std::log((logs - most).exp().mean()));
  }
  return log_sum(all) - std::log(single_shares_.size() > 0 ? 3.0 : 2.0);
}

}  // namespace fathom
