#include "diagnosis/statistics/options.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "diagnosis/statistics/screen.h"
#include "diagnosis/statistics/smooth_score.h"

namespace fathom {

namespace {

constexpr int kKept = 60;                // sets of each size that are considered, …
constexpr double kHopeless = 12.0;       // … unless that far below the best in linear log evidence, …
constexpr std::size_t kRefitted = 8;     // … and refitted, likeliest first
constexpr std::size_t kWithUnknown = 5;  // likeliest sets that are also considered beside something unknown

/// Effects with leeway of which a refit left nothing: by their signatures alone they pass for what their leeway is.
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

/// A fit beside an effect of which there is next to nothing.
Option with_nothing_of(const Case& c, int effect, const Refit& fit) {
  const auto columns = c.problem.signatures(Eigen::all, c.problem.columns[effect]);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(columns.cols());
  Option option{
      fit.hypothesis.effects,
      {},
      false,
      fit.hypothesis.log_evidence + log_evidence(c.problem, 0.0, {effect}, nothing, columns.transpose() * columns),
      fit.prediction};
  const auto place = std::upper_bound(option.effects.begin(), option.effects.end(), effect);
  const auto before = static_cast<Eigen::Index>(columns_of(c.problem, {option.effects.begin(), place}).size());
  option.effects.insert(place, effect);
  const Eigen::VectorXd& there = fit.hypothesis.parameters;
  option.parameters.resize(there.size() + nothing.size());
  option.parameters << there.head(before), nothing, there.tail(there.size() - before);
  return option;
}

/// What was not worth a refit may still not be excluded: sets by their signatures; then effects that do not show in
/// these observations, or of which the likeliest amount is none, beside each fit.
void add_unfitted(const Case& c, const std::vector<Hypothesis>& hypotheses, const std::vector<Refit>& fits,
                  std::vector<Option>& options) {
  const double least = options.front().log_posterior - c.settings.delta;
  std::set<std::vector<int>> known;
  for (const Refit& fit : fits) known.insert(fit.hypothesis.effects);
  const std::vector<int> gone = vanished(c.problem, fits);
  for (const Hypothesis& h : hypotheses)
    if (h.log_evidence > least && !holds_any(h.effects, gone) && known.insert(h.effects).second)
      options.push_back({h.effects, h.parameters, false, h.log_evidence,
                         c.problem.signatures(Eigen::all, columns_of(c.problem, h.effects)) * h.parameters});
  for (const Refit& fit : fits)
    for (int effect = 0; effect < static_cast<int>(c.problem.columns.size()); ++effect) {
      if (fit.hypothesis.log_evidence < least || is_said(c.problem, fit.hypothesis.effects, effect)) continue;
      if (Option more = with_nothing_of(c, effect, fit);
          more.log_posterior > least && known.insert(more.effects).second)
        options.push_back(std::move(more));
    }
}

void sort_by_evidence(std::vector<Refit>& fits) {
  std::stable_sort(fits.begin(), fits.end(), [](const Refit& a, const Refit& b) {
    return a.hypothesis.log_evidence > b.hypothesis.log_evidence;
  });
}

/// Where signatures are no straight lines, others come in that only bend them: each of the likeliest fit's effects is
/// left out in turn, as long as that makes a likelier one.
void add_without_one(const Case& c, std::vector<Refit>& fits) {
  for (bool is_better = true; is_better;) {
    const Hypothesis likeliest = fits.front().hypothesis;
    if (likeliest.effects.size() < 2) return;
    for (std::size_t left_out = 0; left_out < likeliest.effects.size(); ++left_out) {
      std::vector<std::size_t> others;
      for (std::size_t e = 0; e < likeliest.effects.size(); ++e)
        if (e != left_out) others.push_back(e);
      const Hypothesis less = part_of(c.problem, likeliest, others);
      const bool is_known =
          std::any_of(fits.begin(), fits.end(), [&](const Refit& f) { return f.hypothesis.effects == less.effects; });
      if (!is_known) fits.push_back(refit(c.evidence, c.predict, c.covariance, c.problem, less));
    }
    sort_by_evidence(fits);
    is_better = fits.front().hypothesis.effects != likeliest.effects;
  }
}

}  // namespace

std::vector<Hypothesis> screened(const Case& c) {
  std::vector<Hypothesis> hypotheses = screen(c.problem, kKept);
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.log_evidence > b.log_evidence; });
  return hypotheses;
}

std::vector<Refit> likeliest_fits(const Case& c, const std::vector<Hypothesis>& hypotheses) {
  std::vector<Refit> result;
  const Eigen::Index n = c.problem.residual.size();
  Refit nothing;
  nothing.prediction = nothing.change = Eigen::VectorXd::Zero(n);
  nothing.jacobian.resize(n, 0);
  result.push_back(std::move(nothing));
  for (const Hypothesis& hypothesis : hypotheses) {
    const std::vector<int> gone = vanished(c.problem, result);
    if (holds_any(hypothesis.effects, gone)) continue;
    const auto best = std::find_if(hypotheses.begin(), hypotheses.end(),
                                   [&](const Hypothesis& h) { return !holds_any(h.effects, gone); });
    if (hypothesis.log_evidence > std::max(0.0, best->log_evidence) - kHopeless &&
        result.size() <= kRefitted + gone.size())
      result.push_back(refit(c.evidence, c.predict, c.covariance, c.problem, hypothesis));
  }
  sort_by_evidence(result);
  add_without_one(c, result);
  return result;
}

std::vector<Option> options_of(const Case& c, const std::vector<Hypothesis>& hypotheses,
                               const std::vector<Refit>& fits) {
  std::vector<Option> options;
  for (const Refit& fit : fits) {
    const Option known{fit.hypothesis.effects, fit.hypothesis.parameters, false, fit.hypothesis.log_evidence,
                       fit.prediction};
    options.push_back(known);
    if (&fit - fits.data() >= static_cast<std::ptrdiff_t>(kWithUnknown) && !known.effects.empty()) continue;
    Eigen::VectorXd left = c.problem.residual - fit.prediction;
    Eigen::MatrixXd smooth = c.shapes.smooth;
    if (fit.jacobian.cols() > 0) {
      const Eigen::MatrixXd explained = orthonormal(fit.jacobian);
      left -= explained * (explained.transpose() * left);
      smooth -= explained * (explained.transpose() * smooth);
    }
    Option with_unknown = known;
    with_unknown.has_unknown = true;
    with_unknown.log_posterior += kLogPriorUnknown + smooth_log_evidence(smooth, left);
    options.push_back(std::move(with_unknown));
  }
  add_unfitted(c, hypotheses, fits, options);
  return options;
}

std::vector<Option> with_imitated(std::vector<Option> options, bool is_tested) {
  constexpr double kByOne = 1.0 / 48.0, kByEachMore = 8.0, kBehindTested = 0.75;
  const Option& best = likeliest(options);
  const auto count = static_cast<int>(best.effects.size());
  if (count == 0 || (count == 1 && !best.has_unknown)) return options;
  Option imitated{{}, {}, true, best.log_posterior + (count - 1) * std::log(kByEachMore), best.prediction};
  if (!best.has_unknown) imitated.log_posterior += std::log(kByOne);
  if (is_tested)
    imitated.log_posterior = std::min(imitated.log_posterior, best.log_posterior + std::log(kBehindTested));
  imitated.prediction.setZero();
  const auto known = std::find_if(options.begin(), options.end(), std::mem_fn(&Option::is_unknown_alone));
  if (known == options.end())
    options.push_back(std::move(imitated));
  else
    known->log_posterior = std::max(known->log_posterior, imitated.log_posterior);
  return options;
}

}  // namespace fathom
