// How much of the scatter comes with a session, a pour, a placement or a single observation, beyond its repeats.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

enum class ErrorLevel { observation, placement, pour, session, model };
std::string name_of(ErrorLevel level);

/// Which observations of an observable share an error of that level; none of the model's, whose groups evidence names.
Groups groups_of(ErrorLevel level, const std::string& observable, const std::vector<Observation>& observations);

/// A random error that is shared by all observations of one observable in a group.
struct VarianceComponent {
  std::string observable;
  ErrorLevel level = ErrorLevel::observation;
  ErrorLevel coarsest = level;                            ///< of the levels that have the same groups
  double variance = 0.0;                                  ///< in the observable's unit, squared
  Groups groups;                                          ///< -1 for other observables
  Eigen::VectorXd scale;                                  ///< of the error in each observation; 1 on the whole
  double most = std::numeric_limits<double>::infinity();  ///< what the variance may be; more is a finding
  Estimate found{};                                       ///< of the variance, before that
  double p_beyond = 1.0;  ///< of scatter as large as is found where the variance is at most that
};

/// Z (n × groups): how much of each group's error an observation has.
Eigen::MatrixXd columns_of(const VarianceComponent& component);

/// Adds variance · Z Zᵀ.
void add(const VarianceComponent& component, Eigen::MatrixXd& covariance);

/// Stated σ are estimates themselves: as if each came from 20 trials (they are wrong by a sixth).
inline constexpr double kStatedDof = 20.0;

/// The components of one observable, estimated together: a large pour goes with a small placement.
struct ObservableErrors {
  std::vector<VarianceComponent> components;
  Eigen::MatrixXd covariance;  ///< of the variances' estimates
};

struct ErrorBudget {
  Eigen::VectorXd repeat_variance;  ///< of each mean of repeats
  std::vector<ObservableErrors> observables;
  bool from_replicates = true;  ///< of equal conditions; false: from what a smooth model leaves
};

/// Errors in patches of the image, of each observation beside that of a mean of `pixels`: as the inverse root of its
/// own pixels, at most three times more or less than of its observable's median. 1 where an observable is of no certain
/// number.
Eigen::VectorXd errors_of_means(const std::vector<Observation>& observations, double pixels);

/// The same beside the mean square of its observable.
Eigen::VectorXd relative_errors(const std::vector<Observation>& observations);

/// Variance of the mean of each observation's repeats: their own scatter and the one pooled over its observable and
/// region, weighed by degrees of freedom; outliers among the scatters count no more than three times their median.
Eigen::VectorXd repeat_variances(const std::vector<Observation>& observations);

/// Restricted maximum likelihood (reml.h), for each observable. `known` (n × n) is
/// what repeats and nuisances explain. Means are free in every cell where cells are repeated, so that no effect can
/// pass for an error; otherwise, and of pours that were not repeated with them, a smooth function of the factors and
/// all candidates' sensitivities are.
ErrorBudget estimate_errors(const Evidence& evidence, const Eigen::VectorXd& residual, const Eigen::MatrixXd& known,
                            const Eigen::VectorXd& repeat_variance);

}  // namespace fathom
