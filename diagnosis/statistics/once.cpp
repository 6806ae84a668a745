#include "diagnosis/statistics/once.h"

#include <algorithm>
#include <map>
#include <set>

#include "diagnosis/statistics/folds.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

// An effect s tells sᵀ Σ⁻¹ s of itself, of which each row has its own s (Σ⁻¹ s); with Σ = L Lᵀ and s = L w the latter
// is L⁻ᵀ w.
Anew lacks_anew(const Evidence& evidence, const Covariance& covariance, const Option& option) {
  constexpr std::size_t kOnceOrTwice = 2;
  const Eigen::VectorXd& w = option.prediction;
  const Eigen::VectorXd change = covariance.factor.matrixL() * w, weighted = covariance.factor.matrixU().solve(w);
  const Groups placements = group_by(evidence.observations, placement_key);
  std::map<int, std::size_t> of_session;
  std::set<std::string> pours;
  for (const std::vector<Eigen::Index>& rows : placements.members()) {
    if (change(rows).dot(weighted(rows)) < kInformative * w.squaredNorm()) continue;
    const Observation& o = evidence.observations[rows.front()];
    ++of_session[o.factors.session];
    if (o.factors.liquid != "none") pours.insert(pour_key(o));
  }
  std::size_t most = 0;
  for (const auto& [session, count] : of_session) most = std::max(most, count);
  if (most <= kOnceOrTwice) return Anew::sessions;
  return pours.size() < kFolds ? Anew::pours : Anew::nothing;
}

}  // namespace fathom
