#include "diagnosis/statistics/posterior.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/dense.h"
#include "core/parallel.h"
#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/screen.h"

namespace fathom {

namespace {

const double kLogPriorUnknown = std::log(0.1);  // that something is there which no list holds
constexpr int kKept = 60;                       // sets of each size that are considered, …
constexpr double kHopeless = 12.0;              // … unless that far below the best in linear log evidence, …
constexpr std::size_t kRefitted = 8;            // … and refitted, likeliest first
constexpr std::size_t kWithUnknown = 5;         // likeliest sets that are also considered beside a discrepancy

void sort_by_evidence(std::vector<Refit>& fits) {
  std::stable_sort(fits.begin(), fits.end(), [](const Refit& a, const Refit& b) {
    return a.hypothesis.log_evidence > b.hypothesis.log_evidence;
  });
}

/// Sets of effects by their sensitivities alone, likeliest first, each with the leeway that it has at its size.
std::vector<Refit> screened(const Case& c) {
  std::vector<Refit> sets;
  for (const Hypothesis& h : screen(c.problem, kKept)) {
    const Eigen::MatrixXd sensitivities = c.problem.sensitivities(Eigen::all, columns_of(c.problem, h.effects));
    sets.push_back(weighed(c.problem, h.effects, h.parameters, sensitivities * h.parameters, sensitivities));
  }
  sort_by_evidence(sets);
  return sets;
}

/// Effects with leeway of which a refit left nothing: by their sensitivities alone they pass for what their leeway is.
std::vector<int> vanished(const Problem& problem, const std::vector<Refit>& fits) {
  std::vector<int> result;
  for (const Refit& fit : fits)
    for (std::size_t e = 0; e < fit.hypothesis.effects.size(); ++e)
      if (const int effect = fit.hypothesis.effects[e]; problem.leeways[effect].log_det > 0.0 &&
                                                        part_of(problem, fit.hypothesis, {e}).parameters.isZero(0.0) &&
                                                        !holds_any({effect}, result))
        result.push_back(effect);
  return result;
}

/// Adds the variances' uncertainty, which belongs to what a set leaves.
void add_variances(const Case& c, std::vector<Refit>& sets) {
  Eigen::MatrixXd rests(c.problem.residual.size(), static_cast<Eigen::Index>(sets.size()));
  for (std::size_t i = 0; i < sets.size(); ++i) rests.col(static_cast<Eigen::Index>(i)) = sets[i].rest;
  const Eigen::VectorXd log_factors = c.variances.log_factors(rests);
  for (std::size_t i = 0; i < sets.size(); ++i)
    sets[i].hypothesis.log_evidence += log_factors[static_cast<Eigen::Index>(i)];
}

Refit fitted(const Case& c, const Hypothesis& hypothesis) {
  Refit fit = refit(c.evidence, c.predict, c.covariance, c.problem, hypothesis);
  fit.hypothesis.log_evidence += c.variances.log_factor(fit.rest);
  return fit;
}

Hypothesis without_effect(const Problem& problem, const Hypothesis& whole, std::size_t left_out) {
  std::vector<std::size_t> others;
  for (std::size_t e = 0; e < whole.effects.size(); ++e)
    if (e != left_out) others.push_back(e);
  return part_of(problem, whole, others);
}

/// Where sensitivities are no straight lines, others come in that only bend them: each of the likeliest fit's effects
/// is left out in turn, as long as that makes a likelier one.
void add_without_one(const Case& c, std::vector<Refit>& fits) {
  for (bool is_better = true; is_better;) {
    const Hypothesis likeliest = fits.front().hypothesis;
    if (likeliest.effects.size() < 2) return;
    for (std::size_t left_out = 0; left_out < likeliest.effects.size(); ++left_out) {
      const Hypothesis less = without_effect(c.problem, likeliest, left_out);
      if (!find_fit(fits, less.effects)) fits.push_back(fitted(c, less));
    }
    sort_by_evidence(fits);
    is_better = fits.front().hypothesis.effects != likeliest.effects;
  }
}

/// Where sensitivities bend, sets that look nearly the same may be far apart in linear evidence. So what each of the
/// likeliest set's effects is confusable with takes its place in turn: of those the most alike.
void add_confusable(const Case& c, std::vector<Refit>& fits) {
  constexpr double kLeastCosine = 0.966;  // 15°, as limits.h lists them
  constexpr std::size_t kMost = 4;
  const Problem& problem = c.problem;
  const Hypothesis likeliest = fits.front().hypothesis;
  std::vector<std::pair<double, Hypothesis>> alike;
  for (std::size_t e = 0; e < likeliest.effects.size(); ++e) {
    const Hypothesis others = without_effect(problem, likeliest, e), own = part_of(problem, likeliest, {e});
    const auto sensitivity = [&](const std::vector<int>& effects) -> Eigen::MatrixXd {
      return problem.sensitivities(Eigen::all, columns_of(problem, effects));
    };
    const Eigen::MatrixXd explained = orthonormal(sensitivity(others.effects));
    const Eigen::VectorXd change = without(sensitivity(own.effects) * own.parameters, explained);
    for (int effect = 0; effect < static_cast<int>(problem.columns.size()); ++effect) {
      if (is_said(problem, likeliest.effects, effect)) continue;
      const Eigen::MatrixXd other = without(sensitivity({effect}), explained);
      if (other.isZero(0.0)) continue;
      const std::vector<Eigen::Index>& columns = problem.columns[effect];
      const Eigen::VectorXd parameters =
          least_squares(other, change).cwiseMax(problem.lower(columns)).cwiseMin(problem.upper(columns));
      const Eigen::VectorXd changes = other * parameters;
      if (const double cosine = changes.dot(change) / (changes.norm() * change.norm()); cosine > kLeastCosine)
        alike.emplace_back(cosine, with_effect(problem, others, effect, parameters));
    }
  }
  std::stable_sort(alike.begin(), alike.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (alike.size() > kMost) alike.erase(alike.begin() + kMost, alike.end());
  for (const auto& [cosine, hypothesis] : alike)
    if (!find_fit(fits, hypothesis.effects)) fits.push_back(fitted(c, hypothesis));
  sort_by_evidence(fits);
}

/// The likeliest sets, the empty one among them.
std::vector<Refit> likeliest_fits(const Case& c, const std::vector<Refit>& sets) {
  Refit nothing;
  nothing.prediction = nothing.change = Eigen::VectorXd::Zero(c.problem.residual.size());
  nothing.rest = c.problem.residual;
  nothing.jacobian.resize(c.problem.residual.size(), 0);
  nothing.hypothesis.log_evidence = c.variances.log_factor(c.problem.residual);
  std::vector<Refit> result{std::move(nothing)};
  for (const Refit& set : sets) {
    const std::vector<int> gone = vanished(c.problem, result);
    if (holds_any(set.hypothesis.effects, gone)) continue;
    const auto best = std::find_if(sets.begin(), sets.end(),
                                   [&](const Refit& one) { return !holds_any(one.hypothesis.effects, gone); });
    if (set.hypothesis.log_evidence > std::max(0.0, best->hypothesis.log_evidence) - kHopeless &&
        result.size() <= kRefitted + gone.size())
      result.push_back(fitted(c, set.hypothesis));
  }
  sort_by_evidence(result);
  add_without_one(c, result);
  add_confusable(c, result);
  return result;
}

Option option_of(const Refit& fit) {
  return {fit.hypothesis.effects, fit.hypothesis.parameters, false, fit.hypothesis.log_evidence, fit.prediction};
}

Option beside_unknown(const Case& c, const Refit& fit) {
  Option option = option_of(fit);
  option.has_unknown = true;
  const Eigen::VectorXd& at = fit.hypothesis.parameters;
  const std::vector<Eigen::Index> columns = columns_of(c.problem, option.effects);
  const Leeway leeway = leeway_beside(c.problem, option.effects, at);
  const LinearEffects effects{leeway.whiten(c.problem.residual - fit.change + fit.jacobian * at),
                              leeway.whiten(fit.jacobian), at, c.problem.lower(columns), c.problem.upper(columns)};
  std::vector<double> logs;
  for (const auto& [log_weight, one] : beside(c.discrepancy, c.variances, effects))
    logs.push_back(log_weight + one.log_likelihood +
                   log_evidence(c.problem, one.gain, option.effects, one.parameters, one.gram));
  // Where sensitivities bend, the linear response is not what was measured.
  option.log_posterior = kLogPriorUnknown + log_sum(logs) +
                         0.5 * (c.problem.residual.squaredNorm() - effects.response.squaredNorm() - leeway.log_det);
  return option;
}

/// Sets that are likely beside a discrepancy, though alone they leave too much: where a discrepancy may be had, fewer
/// effects do.
std::vector<Hypothesis> screened_beside_unknown(const Case& c) {
  constexpr int kOfEachSize = 2;
  constexpr std::size_t kLargest = 2;
  Problem beside = c.problem;
  const Eigen::Index sensitivities = beside.sensitivities.cols();
  Eigen::MatrixXd both(beside.residual.size(), 1 + sensitivities);
  both << beside.residual, beside.sensitivities;
  both = whiten_beside(c.discrepancy, c.problem.residual, both);
  beside.residual = both.col(0);
  beside.sensitivities = both.rightCols(sensitivities);
  std::vector<Hypothesis> sets = screen(beside, kOfEachSize, kLargest);
  std::erase_if(sets, [](const Hypothesis& h) { return h.log_evidence < 0.0; });
  return sets;
}

/// A fit beside an effect of which there is next to nothing.
Option with_nothing_of(const Case& c, int effect, const Refit& fit) {
  const auto columns = c.problem.sensitivities(Eigen::all, c.problem.columns[effect]);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(columns.cols());
  Option option = option_of(fit);
  option.log_posterior += log_evidence(c.problem, 0.0, {effect}, nothing, columns.transpose() * columns);
  Hypothesis more = with_effect(c.problem, fit.hypothesis, effect, nothing);
  option.effects = std::move(more.effects);
  option.parameters = std::move(more.parameters);
  return option;
}

/// Of sets that were only screened, those that are neither fitted nor hold what a refit left nothing of.
void keep_unfitted(const Problem& problem, const std::vector<Refit>& fits, std::vector<Refit>& sets) {
  const std::vector<int> gone = vanished(problem, fits);
  std::erase_if(sets, [&](const Refit& set) {
    return holds_any(set.hypothesis.effects, gone) || find_fit(fits, set.hypothesis.effects);
  });
}

/// With the errors' uncertainty a set that was not worth a refit may be likelier than all that were. It is fitted as
/// well: where sensitivities bend it may not be.
void fit_likelier(const Case& c, std::vector<Refit>& sets, std::vector<Refit>& fits) {
  add_variances(c, sets);
  sort_by_evidence(sets);
  for (std::size_t more = 0; more < kRefitted && !sets.empty(); ++more) {
    if (sets.front().hypothesis.log_evidence <= fits.front().hypothesis.log_evidence) return;
    fits.push_back(fitted(c, sets.front().hypothesis));
    sort_by_evidence(fits);
    keep_unfitted(c.problem, fits, sets);
  }
}

/// What was not worth a refit may still not be excluded: sets by their sensitivities; then effects that do not show in
/// these observations, or of which the likeliest amount is none, beside each fit.
void add_unfitted(const Case& c, const std::vector<Refit>& sets, const std::vector<Refit>& fits,
                  std::vector<Option>& options) {
  const double least = likeliest(options).log_posterior - c.settings.delta;
  std::set<std::vector<int>> known;
  for (const Refit& fit : fits) known.insert(fit.hypothesis.effects);
  for (const Refit& set : sets) {
    if (set.hypothesis.log_evidence <= least || !known.insert(set.hypothesis.effects).second) continue;
    options.push_back(option_of(set));
  }
  for (const Refit& fit : fits)
    for (int effect = 0; effect < static_cast<int>(c.problem.columns.size()); ++effect) {
      if (fit.hypothesis.log_evidence < least || is_said(c.problem, fit.hypothesis.effects, effect)) continue;
      if (Option more = with_nothing_of(c, effect, fit);
          more.log_posterior > least && known.insert(more.effects).second)
        options.push_back(std::move(more));
    }
}

}  // namespace

const Refit* find_fit(const std::vector<Refit>& fits, const std::vector<int>& effects) {
  const auto found =
      std::find_if(fits.begin(), fits.end(), [&](const Refit& f) { return f.hypothesis.effects == effects; });
  return found == fits.end() ? nullptr : &*found;
}

Posterior posterior_of(const Case& c) {
  std::vector<Refit> sets = screened(c);
  Posterior posterior{{}, likeliest_fits(c, sets)};
  keep_unfitted(c.problem, posterior.fits, sets);
  fit_likelier(c, sets, posterior.fits);
  std::set<std::vector<int>> beside{{}};
  for (std::size_t k = 0; k < std::min(kWithUnknown, posterior.fits.size()); ++k)
    beside.insert(posterior.fits[k].hypothesis.effects);
  for (const Hypothesis& h : screened_beside_unknown(c)) {
    beside.insert(h.effects);
    if (!find_fit(posterior.fits, h.effects)) posterior.fits.push_back(fitted(c, h));
  }
  sort_by_evidence(posterior.fits);
  keep_unfitted(c.problem, posterior.fits, sets);
  std::vector<std::optional<Option>> with_unknown(posterior.fits.size());
  parallel_items(static_cast<int>(posterior.fits.size()), [&](int i) {
    if (const Refit& fit = posterior.fits[i]; beside.contains(fit.hypothesis.effects))
      with_unknown[i] = beside_unknown(c, fit);
  });
  for (std::size_t i = 0; i < posterior.fits.size(); ++i) {
    posterior.options.push_back(option_of(posterior.fits[i]));
    if (with_unknown[i]) posterior.options.push_back(*std::move(with_unknown[i]));
  }
  add_unfitted(c, sets, posterior.fits, posterior.options);
  return posterior;
}

Shares shares_of(const std::vector<Option>& options) {
  const double best = likeliest(options).log_posterior;
  Shares shares;
  double sum = 0.0;
  for (const Option& o : options) {
    const double weight = std::exp(o.log_posterior - best);
    sum += weight;
    if (o.has_unknown) shares.unknown += weight;
    if (o.is_nothing()) shares.nothing += weight;
    if (!o.effects.empty()) shares.effects += weight;
  }
  return {shares.nothing / sum, shares.unknown / sum, shares.effects / sum};
}

void weigh_failed_check(double p, std::vector<Option>& options) {
  const double bounded = std::clamp(p, 1e-300, 1.0 / std::numbers::e);  // there it says nothing
  const double log_odds = kLogPriorUnknown - 1.0 - std::log(bounded) - std::log(-std::log(bounded));
  std::map<std::vector<int>, double> beside_unknown;  // log posteriors
  for (const Option& option : options)
    if (option.has_unknown) beside_unknown[option.effects] = option.log_posterior;
  std::vector<Option> failed;
  for (const Option& option : options) {
    if (option.has_unknown) continue;
    Option more = option;
    more.has_unknown = true;
    more.log_posterior += log_odds;
    if (const auto known = beside_unknown.find(option.effects); known != beside_unknown.end())
      more.log_posterior = std::max(more.log_posterior, known->second);
    failed.push_back(std::move(more));
  }
  std::erase_if(options, [](const Option& option) { return option.has_unknown; });
  std::ranges::move(failed, std::back_inserter(options));
}

double probability_of(int effect, const std::vector<Option>& options, const std::vector<int>& kinds) {
  const double best = likeliest(options).log_posterior;
  double with = 0.0, sum = 0.0;
  for (const Option& o : options) {
    const double weight = std::exp(o.log_posterior - best);
    sum += weight;
    if (kinds_of(o, kinds).contains(kinds[effect])) with += weight;
  }
  return with / sum;
}

}  // namespace fathom
