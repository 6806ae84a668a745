#include "diagnosis/statistics/strata.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr std::size_t kFewestInPair = 3;

std::vector<Stratum> strata_by(const std::vector<Observation>& observations, const std::string& observable,
                               const std::vector<std::string>& factors) {
  std::vector<std::string> names;
  const Groups groups = group_by(observations, [&](const Observation& o) {
    std::string name;
    if (o.observable != observable) return name;
    for (const std::string& factor : factors) {
      const std::string value = level(o, factor);
      if (value.empty()) return std::string();
      name += (name.empty() ? "" : ", ") + factor + "=" + value;
    }
    return name.empty() ? std::string("all") : name;
  });
  std::vector<Stratum> result;
  for (auto& rows : groups.members()) {
    std::string name;
    for (const std::string& factor : factors)
      name += (name.empty() ? "" : ", ") + factor + "=" + level(observations[rows[0]], factor);
    result.push_back({observable, name.empty() ? "all" : name, factors.size() < 2, std::move(rows)});
  }
  return result;
}

/// The rows of one observable that were measured in the first, second and last third of a span of time.
std::vector<Stratum> strata_by_time(const std::vector<Observation>& observations, const std::vector<Eigen::Index>& rows,
                                    const std::string& name, const std::function<std::string(const Observation&)>& span,
                                    double Factors::*time) {
  static constexpr std::array kThirds{"early", "middle", "late"};
  std::map<std::string, std::pair<double, double>> spans;
  for (const auto row : rows) {
    const double t = observations[row].factors.*time;
    auto& [first, last] = spans.try_emplace(span(observations[row]), t, t).first->second;
    first = std::min(first, t);
    last = std::max(last, t);
  }
  std::vector<Stratum> result;
  for (const char* third : kThirds) result.push_back({observations[rows[0]].observable, name + "=" + third, true, {}});
  for (const auto row : rows) {
    const auto [first, last] = spans.at(span(observations[row]));
    if (last <= first) continue;
    const double share = (observations[row].factors.*time - first) / (last - first);
    result[static_cast<std::size_t>(std::clamp(3.0 * share, 0.0, 2.0))].rows.push_back(row);
  }
  return result;
}

}  // namespace

std::vector<Stratum> list_strata(const std::vector<Observation>& observations) {
  std::vector<Stratum> result;
  std::set<std::vector<Eigen::Index>> known;
  const Groups observables = group_by(observations, [](const Observation& o) { return o.observable; });
  const auto add = [&](std::vector<Stratum> strata, std::size_t fewest) {
    for (Stratum& stratum : strata)
      if (stratum.rows.size() >= fewest && known.insert(stratum.rows).second) result.push_back(std::move(stratum));
  };
  for (const auto& rows : observables.members()) {
    const std::string& observable = observations[rows[0]].observable;
    const auto& factors = factor_names();
    add(strata_by(observations, observable, {}), 1);
    for (const std::string& factor : factors) add(strata_by(observations, observable, {factor}), 1);
    for (std::size_t i = 0; i < factors.size(); ++i)
      for (std::size_t j = i + 1; j < factors.size(); ++j)
        add(strata_by(observations, observable, {factors[i], factors[j]}), kFewestInPair);
    if (observations[rows[0]].factors.within_mm || observations[rows[0]].is_of_session) continue;
    // What drifts, and what evaporates.
    add(strata_by_time(observations, rows, "time", session_key, &Factors::time_s), kFewestInPair);
    add(strata_by_time(observations, rows, "time_since_pour", pour_key, &Factors::stood_s), kFewestInPair);
  }
  return result;
}

Eigen::MatrixXd stratum_columns(const std::vector<Stratum>& strata, const Covariance& covariance) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(covariance.total.rows(), static_cast<Eigen::Index>(strata.size()));
  for (std::size_t k = 0; k < strata.size(); ++k)
    for (const auto row : strata[k].rows) columns(row, static_cast<Eigen::Index>(k)) = 1.0;
  return covariance.whiten(columns);
}

}  // namespace fathom
