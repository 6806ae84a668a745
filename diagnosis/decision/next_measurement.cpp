#include "diagnosis/decision/next_measurement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/dense.h"
#include "diagnosis/decision/explanations.h"
#include "diagnosis/statistics/leeway.h"
#include "diagnosis/statistics/problem.h"
#include "diagnosis/statistics/shared_errors.h"

namespace fathom {
namespace {

constexpr std::size_t kLikeliest = 4;

/// Variance of one repeat of each observable and region, as it was found; of the observable where a region is new.
class RepeatVariances {
 public:
  RepeatVariances(const Evidence& evidence, const Covariance& covariance) {
    for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
      const Observation& o = evidence.observations[i];
      const double variance = covariance.errors.repeat_variance[static_cast<Eigen::Index>(i)] * o.repeats;
      for (const std::string& region : {o.factors.region, kAnyRegion}) {
        Mean& mean = means_[{o.observable, region}];
        mean.sum += variance, ++mean.count;
      }
    }
  }

  /// 0 of an observable that was never measured.
  double operator()(const Observation& o) const {
    auto found = means_.find({o.observable, o.factors.region});
    if (found == means_.end()) found = means_.find({o.observable, kAnyRegion});
    return found == means_.end() ? 0.0 : found->second.sum / found->second.count;
  }

 private:
  struct Mean {
    double sum = 0.0;
    int count = 0;
  };
  const std::string kAnyRegion = "*";
  std::map<std::pair<std::string, std::string>, Mean> means_;
};

/// The same component in other observations; of the model's errors nothing (see model_variances()).
VarianceComponent component_in(const std::vector<Observation>& observations, VarianceComponent component) {
  component.scale = component.level == ErrorLevel::observation
                        ? relative_errors(observations)
                        : Eigen::VectorXd::Ones(static_cast<Eigen::Index>(observations.size()));
  component.groups = groups_of(component.level, component.observable, observations);
  return component;
}

/// Of the model's shared errors, in their order among those of their observable: as large as they were found.
std::map<std::string, std::vector<double>> model_variances(const Covariance& covariance) {
  std::map<std::string, std::vector<double>> variances;
  for (const ObservableErrors& errors : covariance.errors.observables)
    for (const VarianceComponent& component : errors.components)
      if (component.level == ErrorLevel::model) variances[component.observable].push_back(component.variance);
  return variances;
}

/// Of the new observations, nuisances apart: numerical errors, repeats, and the components that the old ones show.
Eigen::MatrixXd covariance_of_new(const Evidence& old, const Covariance& covariance, const Evidence& added) {
  const auto n = static_cast<Eigen::Index>(added.observations.size());
  const RepeatVariances repeats(old, covariance);
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    total(i, i) = std::pow(added.numerical_sd[i], 2.0) + repeats(added.observations[i]) / added.observations[i].repeats;
  for (const ObservableErrors& errors : covariance.errors.observables)
    for (const VarianceComponent& component : errors.components)
      add(component_in(added.observations, component), total);
  const std::map<std::string, std::vector<double>> found = model_variances(covariance);
  std::map<std::string, std::size_t> ordinals;
  for (VarianceComponent& component : expected_shared_errors(added)) {
    const std::size_t ordinal = ordinals[component.observable]++;
    const auto known = found.find(component.observable);
    if (known != found.end() && ordinal < known->second.size()) component.variance = known->second[ordinal];
    add(component, total);
  }
  return total;
}

/// What effects change in observations, per prior scale: one column for each of their parameters.
Eigen::MatrixXd sensitivities(const Evidence& evidence, const std::vector<const Candidate*>& candidates) {
  std::vector<Eigen::VectorXd> columns;
  const auto n = static_cast<Eigen::Index>(evidence.observations.size());
  for (const Candidate* known : candidates) {
    const auto seen = std::find_if(evidence.candidates.begin(), evidence.candidates.end(),
                                   [&](const Candidate& c) { return c.effect == known->effect; });
    for (std::size_t k = 0; k < known->parameters.size(); ++k) {
      columns.emplace_back(Eigen::VectorXd::Zero(n));
      if (seen != evidence.candidates.end())
        columns.back() = known->parameters[k].prior_scale * seen->sensitivity.col(static_cast<Eigen::Index>(k));
    }
  }
  Eigen::MatrixXd result(n, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = columns[k];
  return result;
}

/// What comes with an explanation's effects in observations and nobody predicts: independent errors, one a column.
Eigen::MatrixXd own_errors(const Evidence& evidence, const std::vector<const Candidate*>& effects,
                           const Eigen::VectorXd& parameters) {
  Eigen::MatrixXd errors(static_cast<Eigen::Index>(evidence.observations.size()), 0);
  Eigen::Index first = 0;
  for (const Candidate* known : effects) {
    const double amount = std::abs(parameters[first]);
    first += static_cast<Eigen::Index>(known->parameters.size());
    const auto seen = std::find_if(evidence.candidates.begin(), evidence.candidates.end(),
                                   [&](const Candidate& c) { return c.effect == known->effect; });
    if (seen == evidence.candidates.end() || seen->leeway.columns.cols() == 0) continue;
    const Eigen::MatrixXd& own = seen->leeway.columns;
    errors.conservativeResize(Eigen::NoChange, errors.cols() + own.cols());
    errors.rightCols(own.cols()) = std::sqrt(share_of_variance(seen->leeway.grow_from, amount)) * own;
  }
  return errors;
}

/// The old observations, with what they share with new ones; whitened once for all designs.
struct Old {
  const Evidence& evidence;
  const Covariance& covariance;
  Eigen::MatrixXd nuisances = covariance.whiten(covariance.nuisance);
};

/// An explanation, with what its effects change in the old observations, whitened, and the leeway that it has there.
struct Rival {
  const Option& option;
  std::vector<const Candidate*> effects;
  Eigen::MatrixXd old_sensitivities;
  Leeway old_leeway;

  Rival(const Old& old, const Option& explanation) : option(explanation) {
    for (const int effect : option.effects) effects.push_back(&old.evidence.candidates[effect]);
    old_sensitivities = old.covariance.whiten(sensitivities(old.evidence, effects));
    old_leeway = leeway_of(old.covariance.whiten(own_errors(old.evidence, effects, option.parameters)));
  }
};

/// Old and new observations as they err where an explanation holds, with what they share: nuisances of one name. With N
/// of those, L Lᵀ the covariance of the old observations and C that of the new ones, the factor of both is
/// (L, 0; N_new Wᵀ, R) with W = L⁻¹ N_old and R Rᵀ = C − N_new WᵀW N_newᵀ: what the old ones are is factored once for
/// all designs. An explanation's leeway is anew with each measurement.
class Together {
 public:
  /// `covariance`: of the new observations, nuisances apart.
  Together(const Old& old, const Design& design, const Eigen::MatrixXd& covariance, const Rival& holds)
      : added_(design.evidence), leeway_(holds.old_leeway) {
    std::map<std::string, Eigen::Index> of_old;
    for (std::size_t k = 0; k < old.evidence.nuisances.size(); ++k)
      of_old.emplace(old.evidence.nuisances[k].name, static_cast<Eigen::Index>(k));
    const Eigen::Index added = added_.numerical_sd.size();
    Eigen::MatrixXd nuisances(added, static_cast<Eigen::Index>(added_.nuisances.size()));
    std::vector<Eigen::Index> shared_old, shared_new;
    for (Eigen::Index k = 0; k < nuisances.cols(); ++k) {
      const Nuisance& nuisance = added_.nuisances[k];
      nuisances.col(k) = nuisance.sigma * nuisance.sensitivity;
      const auto same = of_old.find(nuisance.name);
      if (same == of_old.end()) continue;
      shared_old.push_back(same->second);
      shared_new.push_back(k);
    }
    shared_old_ = leeway_.whiten(old.nuisances(Eigen::all, shared_old));
    shared_new_ = nuisances(Eigen::all, shared_new);
    const Eigen::MatrixXd own = own_errors(added_, holds.effects, holds.option.parameters);
    factor_.compute(nuisances * nuisances.transpose() + covariance + own * own.transpose() -
                    shared_new_ * (shared_old_.transpose() * shared_old_) * shared_new_.transpose());
  }

  /// Changes of old and new observations by a rival's effects; whitened.
  Eigen::MatrixXd changes(const Rival& rival) const {
    const Eigen::MatrixXd old = leeway_.whiten(rival.old_sensitivities);
    Eigen::MatrixXd result(old.rows() + factor_.rows(), old.cols());
    if (result.cols() == 0) return result;  // of the model as it is; a matrix without columns has no parts to fill
    result << old,
        factor_.matrixL().solve(sensitivities(added_, rival.effects) - shared_new_ * (shared_old_.transpose() * old));
    return result;
  }

 private:
  const Evidence& added_;
  const Leeway& leeway_;
  Eigen::MatrixXd shared_old_;  ///< W
  Eigen::MatrixXd shared_new_;
  Eigen::LLT<Eigen::MatrixXd> factor_;  ///< R
};

/// Norm of what columns cannot take from a difference, all whitened.
double left(const Eigen::VectorXd& difference, const Eigen::MatrixXd& hiding) {
  if (hiding.isZero(0.0)) return difference.norm();  // effects that move nothing, or none
  return (difference - hiding * least_squares(hiding, difference)).norm();
}

bool includes(const Option& option, const Option& part) {
  return std::all_of(part.effects.begin(), part.effects.end(), [&](int effect) {
    return std::find(option.effects.begin(), option.effects.end(), effect) != option.effects.end();
  });
}

/// σ by which the new data would speak against `rival` if `truth` held, beside what the old ones say already.
double against(const Together& as_of_rival, const Rival& truth, const Rival& rival) {
  const Eigen::VectorXd difference = as_of_rival.changes(truth) * truth.option.parameters;
  const Eigen::MatrixXd hiding = as_of_rival.changes(rival);
  const Eigen::Index old = rival.old_sensitivities.rows();
  const double by_all = left(difference, hiding), by_old = left(difference.head(old), hiding.topRows(old));
  return std::sqrt(std::max(by_all * by_all - by_old * by_old, 0.0));
}

double t_criterion(const Together& as_of_first, const Together& as_of_second, const Rival& first, const Rival& second) {
  if (includes(first.option, second.option)) return against(as_of_second, first, second);
  if (includes(second.option, first.option)) return against(as_of_first, second, first);
  return std::min(against(as_of_second, first, second), against(as_of_first, second, first));
}

std::vector<std::string> names(const Evidence& evidence, const Option& option) {
  std::vector<std::string> result;
  for (const int effect : option.effects) result.push_back(evidence.candidates[effect].effect);
  return result;
}

}  // namespace

double t_criterion(const Evidence& evidence, const Covariance& covariance, const Design& design, const Option& first,
                   const Option& second) {
  const Old old{evidence, covariance};
  const Rival one(old, first), other(old, second);
  const Eigen::MatrixXd added = covariance_of_new(evidence, covariance, design.evidence);
  return t_criterion(Together(old, design, added, one), Together(old, design, added, other), one, other);
}

std::vector<NextMeasurement> next_measurements(const Evidence& evidence, const Covariance& covariance,
                                               const Designs& designs, const AmbiguitySet& set) {
  const Old old{evidence, covariance};
  const std::vector<int> kinds = kinds_of_candidates(evidence);
  std::vector<Rival> rivals;
  std::set<std::set<int>> known;  // of which liquids effects are is not asked
  std::set<std::string> effects;
  for (const AmbiguityClass& alike : set.classes)
    for (const Option& option : alike.options) {
      if (option.has_unknown || option.is_too_small() || rivals.size() == kLikeliest ||
          !known.insert(kinds_of(option, kinds)).second)
        continue;
      rivals.emplace_back(old, option);
      for (const int effect : option.effects) effects.insert(evidence.candidates[effect].effect);
    }
  if (rivals.size() < 2) return {};
  const std::vector<Design> possible = designs({effects.begin(), effects.end()});
  std::vector<std::vector<Together>> together;  // of each design, as each rival has it
  for (const Design& design : possible) {
    const Eigen::MatrixXd added = covariance_of_new(evidence, covariance, design.evidence);
    std::vector<Together>& as_of = together.emplace_back();
    for (const Rival& rival : rivals) as_of.emplace_back(old, design, added, rival);
  }
  std::vector<NextMeasurement> result;
  for (std::size_t i = 0; i < rivals.size(); ++i)
    for (std::size_t j = i + 1; j < rivals.size(); ++j) {
      // Whatever settles it comes before what does not.
      const auto worth = [](const NextMeasurement& next) {
        return std::pair(next.settles(), next.settles() ? next.sigma * next.sigma / next.cost : next.sigma);
      };
      std::vector<NextMeasurement> each;
      for (std::size_t d = 0; d < possible.size(); ++d)
        each.push_back({possible[d].name,
                        {names(evidence, rivals[i].option), names(evidence, rivals[j].option)},
                        t_criterion(together[d][i], together[d][j], rivals[i], rivals[j]),
                        possible[d].cost});
      const auto best =
          std::max_element(each.begin(), each.end(),
                           [&](const NextMeasurement& a, const NextMeasurement& b) { return worth(a) < worth(b); });
      if (best != each.end()) result.push_back(*best);
    }
  return result;
}

}  // namespace fathom
