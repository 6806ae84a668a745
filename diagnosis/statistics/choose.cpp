#include "diagnosis/statistics/choose.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/confirm.h"

namespace fathom {

namespace {

constexpr int kVerified = 8;  // sets that are put to the tests, at most
constexpr int kConfirmationDraws = 300;

/// Whether some main stratum becomes significantly worse, by more than its u_val.
bool worsens(const Case& c, const Refit& fit) {
  for (std::size_t k = 0; k < c.shapes.strata.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::VectorXd direction = c.shapes.stratum_columns.col(column).normalized();
    const double before = std::abs(direction.dot(c.problem.residual));
    const double after = std::abs(direction.dot(c.problem.residual - fit.prediction));
    const double p_after = c.gap.scan_tail.p(normal_score(after, c.shapes.stratum_dof[column]));
    if (c.shapes.strata[k].is_main && after > before + 1.0 && p_after < c.settings.p_gap) return true;
  }
  return false;
}

/// The effects of a fit with their evidence, if all of them pass all tests.
std::optional<std::vector<NamedEffect>> verified(const Case& c, const Refit& fit) {
  const std::vector<EffectSize> sizes = sizes_beside_others(c.problem, c.covariance, fit.hypothesis, fit.jacobian);
  // A set of which no effect shows alone was one of many sets, not of many effects.
  const double sets = static_cast<double>(c.problem.columns.size());
  bool shows_alone = false;
  for (const int effect : fit.hypothesis.effects)
    shows_alone |= c.discovery.p(z_alone(c.spaces[effect], c.problem.residual)) < c.settings.p_discovery;
  std::vector<NamedEffect> effects(sizes.size());
  for (std::size_t e = 0; e < sizes.size(); ++e) {
    effects[e].name = c.evidence.candidates[fit.hypothesis.effects[e]].effect;
    effects[e].p_discovery = std::min(1.0, c.discovery.p(sizes[e].z) * (shows_alone ? 1.0 : sets));
    if (effects[e].p_discovery >= c.settings.p_discovery) return std::nullopt;
  }
  std::vector<double> dof;
  for (const EffectSize& size : sizes) dof.push_back(size.dof);
  const Eigen::MatrixXd draws =
      c.covariance.factor.matrixL() * c.draws.leftCols(std::min<Eigen::Index>(kConfirmationDraws, c.draws.cols()));
  const std::vector<Confirmation> confirmations = confirm(
      c.evidence.observations, c.covariance, linear_fit(c.covariance, c.problem, fit), draws, dof, c.settings.seed);
  for (std::size_t e = 0; e < sizes.size(); ++e) {
    const Confirmation& confirmation = confirmations[e];
    effects[e].p_confirmation = confirmation.p;
    effects[e].p_sign_flip = confirmation.p_sign_flip;
    effects[e].folds = confirmation.folds_informative;
    effects[e].folds_improved = confirmation.folds_improved;
    const int against = confirmation.folds_informative - confirmation.folds_improved;
    if (confirmation.p >= c.settings.p_confirmation || against > 1) return std::nullopt;
  }
  if (worsens(c, fit)) return std::nullopt;
  return effects;
}

}  // namespace

std::optional<Choice> choose(const Case& c, const std::vector<Refit>& fits) {
  const Hypothesis& first = fits.front().hypothesis;
  int tried = 0;
  for (const Refit& fit : fits) {
    const Hypothesis& h = fit.hypothesis;
    if (tried == kVerified) return std::nullopt;
    if (h.effects.empty()) continue;
    const bool is_subset =
        std::includes(first.effects.begin(), first.effects.end(), h.effects.begin(), h.effects.end());
    if (!is_subset && h.log_evidence < first.log_evidence - c.settings.delta) continue;
    ++tried;
    Refit differenced = with_differences(c.evidence, c.predict, c.covariance, c.problem, fit);
    if (auto effects = verified(c, differenced)) return Choice{std::move(differenced), std::move(*effects)};
  }
  return std::nullopt;
}

}  // namespace fathom
