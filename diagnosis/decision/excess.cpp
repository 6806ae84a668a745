#include "diagnosis/decision/excess.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

/// Rows of one observable that several sessions have.
struct BySession {
  std::string observable;
  std::vector<std::string> names;  ///< of the sessions
  std::vector<std::vector<Eigen::Index>> rows;
};

std::vector<BySession> by_session(const std::vector<Observation>& observations) {
  std::vector<BySession> result;
  const Groups observables = group_by(observations, [](const Observation& o) {
    const bool is_stated = o.observable.ends_with("_mm") || o.observable.ends_with("_deg");
    return o.only_names || !is_stated || o.factors.within_mm ? std::string() : o.observable;
  });
  for (const auto& rows : observables.members()) {
    BySession own{observations[rows[0]].observable, {}, {}};
    for (const auto row : rows) {
      const std::string name = session_key(observations[row]);
      const auto session =
          static_cast<std::size_t>(std::find(own.names.begin(), own.names.end(), name) - own.names.begin());
      if (session == own.names.size()) own.names.push_back(name), own.rows.emplace_back();
      own.rows[session].push_back(row);
    }
    if (own.names.size() > 1) result.push_back(std::move(own));
  }
  return result;
}

/// Of two sessions only one is said to differ.
std::size_t first_of(const BySession& sessions) { return sessions.names.size() == 2 ? 1 : 0; }

/// What is looked at: columns (not whitened) and which combination of their means.
struct Contrast {
  Excess excess;
  Eigen::MatrixXd columns;
  Eigen::VectorXd weights;
  bool only_more = false;  ///< less is no finding
};

Eigen::MatrixXd indicators(const std::vector<std::vector<Eigen::Index>>& groups, Eigen::Index n) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(groups.size()));
  for (std::size_t group = 0; group < groups.size(); ++group)
    for (const Eigen::Index row : groups[group]) columns(row, static_cast<Eigen::Index>(group)) = 1.0;
  return columns;
}

/// Each session beside the mean of the others.
void add_sessions(const std::vector<Observation>& observations, std::vector<Contrast>& contrasts) {
  for (const BySession& sessions : by_session(observations)) {
    const auto count = static_cast<Eigen::Index>(sessions.names.size());
    const Eigen::MatrixXd columns = indicators(sessions.rows, static_cast<Eigen::Index>(observations.size()));
    for (std::size_t s = first_of(sessions); s < sessions.names.size(); ++s) {
      Eigen::VectorXd weights = Eigen::VectorXd::Constant(count, -1.0 / static_cast<double>(count - 1));
      weights[static_cast<Eigen::Index>(s)] = 1.0;
      contrasts.push_back({{"session", sessions.names[s], sessions.observable, ""}, columns, std::move(weights)});
    }
  }
}

/// What moves from trial to trial beyond its noise is an observable of its own.
void add_trials(const std::vector<Observation>& observations, std::vector<Contrast>& contrasts) {
  const Groups motions = group_by(observations, [](const Observation& o) {
    return o.observable.ends_with("_motion_deg") ? o.observable : std::string();
  });
  for (const auto& rows : motions.members())
    contrasts.push_back({{"trial", "", observations[rows[0]].observable, ""},
                         indicators({rows}, static_cast<Eigen::Index>(observations.size())),
                         Eigen::VectorXd::Ones(1),
                         true});
}

/// Pours and placements whose heights scatter by more than they may.
std::vector<Excess> scatter_beyond(const ErrorBudget& errors) {
  std::vector<Excess> result;
  for (const ObservableErrors& of : errors.observables)
    for (const VarianceComponent& component : of.components) {
      const auto& [variance, of_variance] = component.found;
      const bool has_repeats = component.level == ErrorLevel::placement || component.level == ErrorLevel::pour;
      if (!has_repeats || std::isinf(component.most) || variance <= 0.0) continue;
      result.push_back({name_of(component.coarsest), "", component.observable, "", std::sqrt(variance),
                        0.5 * of_variance / std::sqrt(variance), component.p_beyond});
    }
  return result;
}

std::vector<Excess> odd_parts(const std::vector<OddDesk>& desks) {
  std::vector<Excess> result;
  for (const OddDesk& desk : desks)
    result.push_back({desk.session ? "session" : "unit", desk.session ? fmt::format("{}", *desk.session) : "",
                      "desk_residual_mm", desk.part, desk.higher_mm, desk.sigma_mm, desk.p});
  return result;
}

}  // namespace

std::vector<Excess> excess_of(const Evidence& evidence, const Covariance& covariance, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& explained, double level) {
  std::vector<Contrast> contrasts;
  add_sessions(evidence.observations, contrasts);
  add_trials(evidence.observations, contrasts);
  std::vector<Excess> looked_at = scatter_beyond(covariance.errors);
  for (Excess& part : odd_parts(evidence.odd_desks)) looked_at.push_back(std::move(part));
  for (const Contrast& contrast : contrasts) {
    const Eigen::MatrixXd columns = without(covariance.whiten(contrast.columns), explained);
    const Eigen::VectorXd weights = columns * (columns.transpose() * columns).ldlt().solve(contrast.weights);
    Excess excess = contrast.excess;
    excess.size = weights.dot(residual);
    excess.sigma = weights.norm();
    if (!(excess.sigma > 0.0) || !std::isfinite(excess.size) || (contrast.only_more && excess.size < 0.0)) continue;
    const double z = normal_score(std::abs(excess.size) / excess.sigma, degrees_of_freedom(covariance, weights)[0]);
    excess.p = std::erfc(z / std::sqrt(2.0));
    looked_at.push_back(std::move(excess));
  }
  std::vector<Excess> result;
  for (Excess& excess : looked_at) {
    excess.p = std::min(1.0, static_cast<double>(looked_at.size()) * excess.p);
    if (excess.p < level) result.push_back(std::move(excess));
  }
  std::stable_sort(result.begin(), result.end(), [](const Excess& a, const Excess& b) {
    return std::abs(a.size) / a.sigma > std::abs(b.size) / b.sigma;
  });
  return result;
}

}  // namespace fathom
