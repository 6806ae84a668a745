#include "diagnosis/statistics/variance_components.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/median.h"
#include "diagnosis/statistics/mean_space.h"
#include "diagnosis/statistics/reml.h"

namespace fathom {

namespace {

constexpr double kPooledDof = 10.0;     // weight of the pooled scatter beside an observation's own
constexpr double kOutlier = 3.0;        // times the median scatter
constexpr std::size_t kFewestRows = 4;  // of an observable whose errors can be told from its mean

/// The components of one observable that can be told apart, over its rows.
std::vector<VarianceComponent> candidates_of(const std::string& observable,
                                             const std::vector<Observation>& observations) {
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(observations.size()));
  std::vector<VarianceComponent> result;
  for (const ErrorLevel level :
       {ErrorLevel::observation, ErrorLevel::placement, ErrorLevel::pour, ErrorLevel::session}) {
    if (level == ErrorLevel::pour && observable.starts_with("desk_")) continue;  // what is poured moves no desk
    Groups groups = groups_of(level, observable, observations);
    if (!result.empty() && result.back().groups.count == groups.count)
      result.back().coarsest = level;
    else if (groups.count >= 2)
      result.push_back({observable, level, level, 0.0, std::move(groups),
                        level == ErrorLevel::observation ? relative_errors(observations) : alike});
  }
  return result;
}

/// Z Zᵀ between contrasts K (rows × m), from K's rows summed over each group.
Eigen::MatrixXd shared(const VarianceComponent& component, const std::vector<Eigen::Index>& rows,
                       const Eigen::MatrixXd& contrasts) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(component.groups.count, contrasts.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const int group = component.groups.of[rows[i]]; group >= 0)
      sums.row(group) += component.scale[rows[i]] * contrasts.row(static_cast<Eigen::Index>(i));
  return sums.transpose() * sums;
}

/// 1 σ that the laboratory states of what differs from one group of a level to the next.
double stated_sd(ErrorLevel level, const std::string& observable, const StatedScatter& stated) {
  const auto any_if_zero = [](double sd) { return sd > 0.0 ? sd : StatedScatter::kAny; };
  if (level == ErrorLevel::session) {
    if (observable.ends_with("_mm")) return stated.session_mm;
    if (observable.ends_with("_deg")) return stated.session_deg;
  } else if (observable == "height_mm") {
    if (level == ErrorLevel::pour) return any_if_zero(stated.fill_mm);
    if (level == ErrorLevel::placement) return any_if_zero(stated.placement_mm);
  }
  return StatedScatter::kAny;
}

/// What the laboratory states of all levels that have the component's groups, and how much a matcher's errors differ
/// between conditions: a cup that was put down anew shows it other dots.
double most_variance(const VarianceComponent& component, const Evidence& evidence) {
  double most = 0.0;
  for (int level = static_cast<int>(component.level); level <= static_cast<int>(component.coarsest); ++level)
    most += std::pow(stated_sd(static_cast<ErrorLevel>(level), component.observable, evidence.stated), 2.0);
  if (component.level != ErrorLevel::session)
    for (const SharedError& error : evidence.shared_errors)
      if (error.is_by_condition && error.observable == component.observable) most += error.sigma * error.sigma;
  return most;
}

/// Whether two components can hardly be told apart: up to size, their covariances differ by less than a tenth.
bool are_alike(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  constexpr double kLeastCosine = 0.995;
  return one.cwiseProduct(other).sum() > kLeastCosine * one.norm() * other.norm();
}

/// p of a likelihood ratio: the k-th variance is at most so large, the others are what they are found to be then.
double p_of_at_most(double most, std::size_t k, const VarianceFit& fit, const Eigen::VectorXd& contrasts,
                    const Eigen::MatrixXd& known, const std::vector<Eigen::MatrixXd>& shapes) {
  std::vector<Eigen::MatrixXd> others = shapes;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
  const Eigen::MatrixXd limited = known + most * shapes[k];
  const VarianceFit beside = fit_variances(contrasts, limited, others, std::vector<VariancePrior>(others.size()));
  const double ratio = restricted_log_likelihood(contrasts, known, shapes, fit.variances) -
                       restricted_log_likelihood(contrasts, limited, others, beside.variances);
  return 0.5 * std::erfc(std::sqrt(std::max(ratio, 0.0)));
}

/// Adds components that were estimated together, beside those that were before them.
void fit(std::vector<VarianceComponent> components, const std::vector<Eigen::MatrixXd>& shapes,
         const Eigen::VectorXd& contrasts, const Eigen::MatrixXd& known, const Evidence& evidence,
         ObservableErrors& errors) {
  const VarianceFit fit = fit_variances(contrasts, known, shapes, std::vector<VariancePrior>(shapes.size()));
  for (std::size_t k = 0; k < components.size(); ++k) {
    VarianceComponent& component = components[k];
    component.variance = fit.variances[static_cast<Eigen::Index>(k)];
    component.most = most_variance(component, evidence);
    if (component.variance > component.most)
      component.p_beyond = p_of_at_most(component.most, k, fit, contrasts, known, shapes);
  }
  const Eigen::Index before = errors.covariance.rows(), more = fit.covariance.rows();
  errors.covariance.conservativeResizeLike(Eigen::MatrixXd::Zero(before + more, before + more));
  errors.covariance.bottomRightCorner(more, more) = fit.covariance;
  std::move(components.begin(), components.end(), std::back_inserter(errors.components));
}

/// What is more than a component may be is no error but a finding (excess.h).
void limit(ObservableErrors& errors) {
  for (std::size_t k = 0; k < errors.components.size(); ++k) {
    VarianceComponent& component = errors.components[k];
    const auto row = static_cast<Eigen::Index>(k);
    component.found = {component.variance, std::sqrt(errors.covariance(row, row))};
    if (component.variance <= component.most) continue;
    errors.covariance.row(row).setZero();
    errors.covariance.col(row).setZero();
    errors.covariance(row, row) = 2.0 / kStatedDof * std::pow(component.most, 2.0);  // no longer estimated
    component.variance = component.most;
  }
}

/// Of what stands in the means of repeated cells, a smooth model leaves what does not go with it.
void fit_unrepeated(const Evidence& evidence, const std::vector<Eigen::Index>& rows, const Eigen::VectorXd& residual,
                    const Eigen::MatrixXd& known, std::vector<VarianceComponent> components, ObservableErrors& errors) {
  constexpr double kLeastSeen = 0.02;  // of the sum of squares: the rest a smooth function may have made
  const CellMeans means = cell_means(evidence, rows);
  if (means.contrasts.cols() == 0) return;
  const Eigen::MatrixXd contrasts = means.over.transpose() * means.contrasts;
  Eigen::MatrixXd covariance = contrasts.transpose() * known(rows, rows) * contrasts;
  for (const VarianceComponent& component : errors.components)
    covariance += component.variance * shared(component, rows, contrasts);
  std::vector<Eigen::MatrixXd> shapes;
  std::erase_if(components, [&](const VarianceComponent& component) {
    Eigen::MatrixXd shape = shared(component, rows, contrasts);
    const double all = shared(component, rows, means.over.transpose()).trace();
    if (shape.trace() < kLeastSeen * all || (!shapes.empty() && are_alike(shapes.back(), shape))) return true;
    shapes.push_back(std::move(shape));
    return false;
  });
  fit(std::move(components), shapes, contrasts.transpose() * residual(rows), covariance, evidence, errors);
}

}  // namespace

std::string name_of(ErrorLevel level) {
  constexpr const char* kNames[] = {"observation", "placement", "pour", "session", "model"};
  return kNames[static_cast<int>(level)];
}

Groups groups_of(ErrorLevel level, const std::string& observable, const std::vector<Observation>& observations) {
  int row = 0;
  return group_by(observations, [&](const Observation& o) {
    ++row;
    if (o.observable != observable) return std::string();
    switch (level) {
      case ErrorLevel::observation:
        return std::to_string(row);
      case ErrorLevel::placement:
        return placement_key(o);
      case ErrorLevel::pour:
        return pour_key(o);
      case ErrorLevel::session:
        return session_key(o);
      case ErrorLevel::model:
        break;
    }
    return std::string();
  });
}

Eigen::MatrixXd columns_of(const VarianceComponent& component) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(component.scale.size(), component.groups.count);
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    if (const int group = component.groups.of[i]; group >= 0) columns(i, group) = component.scale[i];
  return columns;
}

void add(const VarianceComponent& component, Eigen::MatrixXd& covariance) {
  for (const auto& members : component.groups.members())
    for (const auto i : members)
      for (const auto j : members) covariance(i, j) += component.variance * component.scale[i] * component.scale[j];
}

Eigen::VectorXd errors_of_means(const std::vector<Observation>& observations, double pixels) {
  constexpr double kMost = 3.0;
  Eigen::VectorXd result = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(observations.size()));
  const Groups observables = group_by(observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) {
    std::vector<double> own;
    for (const auto row : rows) own.push_back(observations[row].pixels);
    if (*std::min_element(own.begin(), own.end()) <= 0.0) continue;
    const double typical = median(own);
    for (const auto row : rows)
      result[row] =
          std::sqrt(pixels / typical) * std::clamp(std::sqrt(typical / observations[row].pixels), 1.0 / kMost, kMost);
  }
  return result;
}

Eigen::VectorXd relative_errors(const std::vector<Observation>& observations) {
  Eigen::VectorXd result = errors_of_means(observations, 1.0);
  const Groups observables = group_by(observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members())
    result(rows) /= std::sqrt(result(rows).squaredNorm() / static_cast<double>(rows.size()));
  return result;
}

Eigen::VectorXd repeat_variances(const std::vector<Observation>& observations) {
  const Eigen::VectorXd relative = relative_errors(observations);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.size()));
  const Groups groups =
      group_by(observations, [](const Observation& o) { return o.observable + "/" + o.factors.region; });
  for (const auto& members : groups.members()) {
    std::vector<double> scatters;
    for (const auto i : members)
      if (observations[i].repeats > 1) scatters.push_back(observations[i].repeat_sd / relative[i]);
    if (scatters.empty()) continue;
    const double most =
        median(scatters) > 0.0 ? kOutlier * median(scatters) : *std::max_element(scatters.begin(), scatters.end());
    double squares = 0.0, dof = 0.0;
    for (const auto i : members) {
      const double weight = observations[i].repeats - 1;
      squares += weight * std::pow(std::min(observations[i].repeat_sd / relative[i], most), 2.0);
      dof += weight;
    }
    for (const auto i : members) {
      const double own = observations[i].repeats - 1;
      const double own_squares = own * std::pow(observations[i].repeat_sd, 2.0);
      result[i] = (kPooledDof * relative[i] * relative[i] * squares / dof + own_squares) / (kPooledDof + own) /
                  std::max(1, observations[i].repeats);
    }
  }
  return result;
}

ErrorBudget estimate_errors(const Evidence& evidence, const Eigen::VectorXd& residual, const Eigen::MatrixXd& known,
                            const Eigen::VectorXd& repeat_variance) {
  ErrorBudget budget;
  budget.repeat_variance = repeat_variance;
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) {
    if (rows.size() < kFewestRows || evidence.observations[rows[0]].has_all_errors) continue;
    const MeanSpace means = mean_space(evidence, rows);
    const Eigen::MatrixXd& contrasts = means.contrasts;
    if (contrasts.cols() == 0) continue;
    if (evidence.observations[rows[0]].observable == "height_mm") budget.from_replicates = means.from_replicates;
    std::vector<VarianceComponent> components =
        candidates_of(evidence.observations[rows[0]].observable, evidence.observations);
    // What no contrast sees cannot be estimated: a pour that was never repeated stands in its mean. Nor can what they
    // see as they see a lower level: one of the two would be drawn as large as the other is drawn negative.
    std::vector<Eigen::MatrixXd> shapes;
    std::vector<VarianceComponent> unrepeated;
    std::erase_if(components, [&](VarianceComponent& component) {
      Eigen::MatrixXd shape = shared(component, rows, contrasts);
      const bool is_seen = shape.trace() > 1e-6 * static_cast<double>(rows.size());
      // Sessions have nuisances of their own, and what sets their means apart may be the effect itself.
      if (!is_seen && component.level != ErrorLevel::session) unrepeated.push_back(std::move(component));
      if (!is_seen || (!shapes.empty() && are_alike(shapes.back(), shape))) return true;
      shapes.push_back(std::move(shape));
      return false;
    });
    ObservableErrors errors;
    fit(std::move(components), shapes, contrasts.transpose() * residual(rows),
        contrasts.transpose() * known(rows, rows) * contrasts, evidence, errors);
    if (means.from_replicates && !unrepeated.empty())
      fit_unrepeated(evidence, rows, residual, known, std::move(unrepeated), errors);
    limit(errors);
    budget.observables.push_back(std::move(errors));
  }
  return budget;
}

}  // namespace fathom
