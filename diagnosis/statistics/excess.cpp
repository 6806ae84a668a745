#include "diagnosis/statistics/excess.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/null_calibration.h"

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
    return o.only_names || !is_stated ? std::string() : o.observable;
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

}  // namespace

std::vector<Excess> session_excess(const Evidence& evidence, const Covariance& covariance,
                                   const Eigen::VectorXd& residual, const Eigen::MatrixXd& explained, double level) {
  const std::vector<BySession> all = by_session(evidence.observations);
  double tests = 0.0;
  for (const BySession& sessions : all) tests += static_cast<double>(sessions.names.size() - first_of(sessions));
  std::vector<Excess> result;
  for (const BySession& sessions : all) {
    const auto count = static_cast<Eigen::Index>(sessions.names.size());
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(residual.size(), count);
    for (Eigen::Index s = 0; s < count; ++s)
      for (const Eigen::Index row : sessions.rows[s]) columns(row, s) = 1.0;
    columns = covariance.whiten(columns);
    if (explained.cols() > 0) columns -= explained * (explained.transpose() * columns);
    const Eigen::LDLT<Eigen::MatrixXd> normal(columns.transpose() * columns);
    for (auto s = static_cast<Eigen::Index>(first_of(sessions)); s < count; ++s) {
      Eigen::VectorXd beside_others = Eigen::VectorXd::Constant(count, -1.0 / static_cast<double>(count - 1));
      beside_others[s] = 1.0;
      const Eigen::VectorXd weights = columns * normal.solve(beside_others);
      const double size = weights.dot(residual), sigma = weights.norm();
      if (!(sigma > 0.0) || !std::isfinite(size)) continue;
      const double z = normal_score(std::abs(size) / sigma, degrees_of_freedom(covariance, weights)[0]);
      const double p = std::min(1.0, tests * std::erfc(z / std::sqrt(2.0)));
      if (p < level) result.push_back({"session", sessions.names[s], sessions.observable, size, sigma, p});
    }
  }
  std::stable_sort(result.begin(), result.end(), [](const Excess& a, const Excess& b) {
    return std::abs(a.size) / a.sigma > std::abs(b.size) / b.sigma;
  });
  return result;
}

}  // namespace fathom
