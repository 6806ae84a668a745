#include "diagnosis/statistics/decide.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/budget.h"
#include "diagnosis/statistics/confirm.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/discovery.h"
#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/effect_name.h"
#include "diagnosis/statistics/folds.h"
#include "diagnosis/statistics/gap_test.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/hygiene.h"
#include "diagnosis/statistics/limits.h"
#include "diagnosis/statistics/problem.h"
#include "diagnosis/statistics/refit.h"
#include "diagnosis/statistics/screen.h"
#include "diagnosis/statistics/smooth_score.h"
#include "diagnosis/statistics/sufficiency.h"
#include "diagnosis/statistics/unknown.h"

namespace fathom {

namespace {

constexpr int kKept = 60;             // sets of each size that are considered, …
constexpr double kHopeless = 12.0;    // … unless that far below the best in linear log evidence, …
constexpr std::size_t kRefitted = 8;  // … and refitted, likeliest first
constexpr int kVerified = 8;          // sets that are put to the tests, at most
constexpr int kConfirmationDraws = 300;
constexpr std::size_t kWithUnknown = 5;  // likeliest sets that are also considered beside something unknown
const double kLogPriorUnknown = std::log(0.1);
const double kNamedBesideUnknown = std::log(20.0);  // odds that an effect must add to something unknown

/// All that stays the same while sets of effects are weighed.
struct Case {
  const Evidence& evidence;
  const Predict& predict;
  const DecisionSettings& settings;
  Covariance covariance;
  Problem problem;
  Eigen::MatrixXd draws;  ///< whitened
  GapShapes shapes;
  std::vector<CandidateSpace> spaces;
  MaximumTail discovery, scan;
};

Case prepare(const Evidence& evidence, const Predict& predict, const DecisionSettings& settings) {
  Case c{evidence, predict, settings, estimate_covariance(evidence, measured_minus_predicted(evidence)), {}, {}, {},
         {},       {},      {}};
  c.problem = whitened_problem(evidence, c.covariance);
  c.draws = pseudo_experiments(c.covariance, settings.pseudo_experiments, settings.seed);
  c.shapes = gap_shapes(evidence, c.covariance);
  c.spaces = candidate_spaces(c.problem, c.covariance);
  c.discovery = discovery_tail(c.spaces, c.draws);
  return c;
}

/// By the signatures alone, likeliest first.
std::vector<Hypothesis> screened(const Case& c) {
  std::vector<Hypothesis> hypotheses = screen(c.problem, kKept);
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.log_evidence > b.log_evidence; });
  return hypotheses;
}

/// The likeliest sets, fitted with the model itself; the empty one among them, likeliest first.
std::vector<Refit> fits(const Case& c, const std::vector<Hypothesis>& hypotheses) {
  std::vector<Refit> result;
  const Eigen::Index n = c.problem.residual.size();
  result.push_back({{{}, Eigen::VectorXd(0), 0.0, 0.0}, Eigen::VectorXd::Zero(n), Eigen::MatrixXd(n, 0), 0});
  const double best = hypotheses.empty() ? 0.0 : std::max(0.0, hypotheses.front().log_evidence);
  for (const Hypothesis& hypothesis : hypotheses)
    if (hypothesis.log_evidence > best - kHopeless && result.size() <= kRefitted)
      result.push_back(refit(c.evidence, c.predict, c.covariance, c.problem, hypothesis));
  std::stable_sort(result.begin(), result.end(), [](const Refit& a, const Refit& b) {
    return a.hypothesis.log_evidence > b.hypothesis.log_evidence;
  });
  return result;
}

/// What was not worth a refit may still not be excluded: sets by their signatures, and effects that these observations
/// do not show.
void add_unfitted(const Case& c, const std::vector<Hypothesis>& hypotheses, const std::vector<Refit>& fits,
                  std::vector<Option>& options) {
  for (const Hypothesis& h : hypotheses) {
    const bool is_fitted =
        std::any_of(fits.begin(), fits.end(), [&](const Refit& fit) { return fit.hypothesis.effects == h.effects; });
    if (is_fitted || h.log_evidence < options.front().log_posterior - c.settings.delta) continue;
    options.push_back({h.effects, h.parameters, false, h.log_evidence,
                       c.problem.signatures(Eigen::all, columns_of(c.problem, h.effects)) * h.parameters});
  }
  for (std::size_t effect = 0; effect < c.problem.columns.size(); ++effect) {
    const std::vector<int> alone{static_cast<int>(effect)};
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.problem.columns[effect].size()));
    if (!c.problem.signatures(Eigen::all, c.problem.columns[effect]).isZero(0.0)) continue;
    const Eigen::MatrixXd unseen = Eigen::MatrixXd::Zero(nothing.size(), nothing.size());
    options.push_back({alone, nothing, false, log_evidence(c.problem, 0.0, alone, nothing, unseen),
                       Eigen::VectorXd::Zero(c.problem.residual.size())});
  }
}

std::vector<Option> options_of(const Case& c, const std::vector<Refit>& fits) {
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
  return options;
}

/// Whether some main stratum becomes significantly worse, by more than its u_val.
bool worsens(const Case& c, const Refit& fit) {
  for (std::size_t k = 0; k < c.shapes.strata.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::VectorXd direction = c.shapes.stratum_columns.col(column).normalized();
    const double before = std::abs(direction.dot(c.problem.residual));
    const double after = std::abs(direction.dot(c.problem.residual - fit.prediction));
    const double p_after = c.scan.p(normal_score(after, c.shapes.stratum_dof[column]));
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

struct Choice {
  Refit fit;
  std::vector<NamedEffect> effects;
};

/// The likeliest set that passes all tests, among those that are not much less likely than the first, and its subsets.
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

/// Of the parameters in prior scales.
Eigen::MatrixXd parameter_covariance(const Choice& choice) {
  const Eigen::MatrixXd& J = choice.fit.jacobian;
  return (J.transpose() * J).completeOrthogonalDecomposition().pseudoInverse();
}

/// The same in the parameters' units.
std::vector<std::vector<double>> covariance_in_units(const Case& c, const Choice& choice) {
  std::vector<double> scales;
  for (const int effect : choice.fit.hypothesis.effects)
    for (const Parameter& parameter : c.evidence.candidates[effect].parameters) scales.push_back(parameter.prior_scale);
  const Eigen::MatrixXd covariance = parameter_covariance(choice);
  std::vector<std::vector<double>> rows(scales.size());
  for (std::size_t i = 0; i < scales.size(); ++i)
    for (std::size_t j = 0; j < scales.size(); ++j)
      rows[i].push_back(scales[i] * scales[j] * covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  return rows;
}

void add_parameters(const Case& c, Choice& choice) {
  const Eigen::MatrixXd covariance = parameter_covariance(choice);
  const std::vector<EffectSize> sizes =
      sizes_beside_others(c.problem, c.covariance, choice.fit.hypothesis, choice.fit.jacobian);
  Eigen::Index next = 0;
  for (std::size_t e = 0; e < choice.effects.size(); ++e)
    for (const Parameter& parameter : c.evidence.candidates[choice.fit.hypothesis.effects[e]].parameters) {
      const double value = parameter.nominal + parameter.prior_scale * choice.fit.hypothesis.parameters[next];
      const double half =
          student_quantile(0.025, sizes[e].dof) * parameter.prior_scale * std::sqrt(covariance(next, next));
      ++next;
      NamedParameter named{parameter.name, value, value - half, value + half};
      if (parameter.lower < parameter.upper) {
        named.low95 = std::max(named.low95, parameter.lower);
        named.high95 = std::min(named.high95, parameter.upper);
      }
      choice.effects[e].parameters.push_back(std::move(named));
    }
}

double rms(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0.0 : std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

/// Before: as predicted. After: with the effects, and with nuisances as the (other) data want them within their priors.
void measure_gaps(const Case& c, const Refit& fit, Diagnosis& diagnosis) {
  const Eigen::VectorXd before = c.covariance.factor.matrixL() * c.problem.residual;
  const Eigen::VectorXd left_w = c.problem.residual - fit.prediction;
  const Eigen::VectorXd left = c.covariance.factor.matrixL() * left_w;
  const Eigen::VectorXd solved = c.covariance.factor.matrixU().solve(left_w);
  const Eigen::VectorXd after = left - c.covariance.nuisance * (c.covariance.nuisance.transpose() * solved);
  const Eigen::VectorXd errors = c.covariance.total.diagonal() - c.covariance.nuisance.rowwise().squaredNorm();
  diagnosis.before.assign(before.begin(), before.end());
  diagnosis.after.assign(after.begin(), after.end());
  for (const double variance : errors) diagnosis.error.push_back(std::sqrt(variance));
  std::vector<Eigen::Index> heights;
  for (std::size_t i = 0; i < c.evidence.observations.size(); ++i)
    if (is_height(c.evidence.observations[i])) heights.push_back(static_cast<Eigen::Index>(i));
  if (heights.empty()) return;
  const HeldOut other = held_out(c.covariance, linear_fit(c.covariance, c.problem, fit),
                                 deal_folds(c.evidence.observations, c.settings.seed));
  const auto train = [&](const std::vector<Eigen::Index>& rows) {
    return GapSize{rms(before(rows)), rms(after(rows)), std::sqrt(errors(rows).mean())};
  };
  const auto held = [&](const std::vector<Eigen::Index>& rows) {
    return GapSize{rms(before(rows)), rms(other.residual(rows)), std::sqrt(other.variance(rows).mean())};
  };
  diagnosis.train = train(heights);
  diagnosis.held_out = held(heights);
  for (const std::string factor : {"liquid", "fill_mm", "distance_mm", "lateral_mm"}) {
    std::map<std::string, std::vector<Eigen::Index>> levels;
    for (const Eigen::Index row : heights)
      if (const Observation& o = c.evidence.observations[row]; o.factors.liquid != "none")
        levels[level(o, factor)].push_back(row);
    for (const auto& [name, rows] : levels) diagnosis.strata.push_back({factor + "=" + name, train(rows), held(rows)});
  }
}

std::vector<std::string> words(const Evidence& evidence, const Option& option) {
  std::vector<std::string> result;
  for (const int effect : option.effects) result.push_back(evidence.candidates[effect].effect);
  if (option.has_unknown) result.emplace_back("unknown");
  return result;
}

/// Whether the explanations differ at most in which liquids their effects are of.
bool all_name_the_same(const Evidence& evidence, const AmbiguitySet& set) {
  std::set<std::set<std::string>> names;
  for (const auto& options : set.classes)
    for (const Option& option : options) {
      std::set<std::string> ids;
      for (const std::string& word : words(evidence, option)) ids.insert(effect_name(word).id);
      names.insert(std::move(ids));
    }
  return names.size() == 1;
}

std::vector<Explanation> explanations(const Evidence& evidence, const AmbiguitySet& set) {
  std::vector<Explanation> result;
  for (std::size_t k = 0; k < set.classes.size(); ++k) {
    Explanation explanation{words(evidence, set.classes[k].front()), {}, set.probabilities[k]};
    for (std::size_t i = 1; i < set.classes[k].size(); ++i)
      explanation.alternatives.push_back(words(evidence, set.classes[k][i]));
    result.push_back(std::move(explanation));
  }
  return result;
}

/// Whether the model as it is, is one of the explanations.
bool holds_nothing(const AmbiguitySet& set) {
  return std::any_of(set.classes.begin(), set.classes.end(), [](const std::vector<Option>& options) {
    return std::any_of(options.begin(), options.end(),
                       [](const Option& o) { return o.effects.empty() && !o.has_unknown; });
  });
}

double log_posterior(const std::vector<Option>& options, const std::vector<int>& effects, bool has_unknown) {
  for (const Option& option : options)
    if (option.effects == effects && option.has_unknown == has_unknown) return option.log_posterior;
  return -INFINITY;
}

}  // namespace

Diagnosis decide(const Evidence& evidence, const Predict& predict, const Designs& designs,
                 const DecisionSettings& settings) {
  Diagnosis diagnosis;
  diagnosis.missing = missing_for_diagnosis(evidence);
  if (!diagnosis.missing.empty()) return diagnosis;
  diagnosis.mistakes = evidence.mistakes;
  Case c = prepare(evidence, predict, settings);
  const Eigen::Index n = c.problem.residual.size();
  diagnosis.warnings = hygiene_warnings(evidence);
  if (!c.covariance.errors.from_replicates)
    diagnosis.warnings.emplace_back(
        "hardly any condition was measured twice: errors are taken from what a smooth model leaves");
  diagnosis.budget = uncertainty_budget(evidence, c.covariance);
  diagnosis.confusable = confusable_pairs(evidence, c.problem);
  diagnosis.near_null = near_null_directions(evidence, c.problem);

  const GapTest gap = gap_test(c.shapes, c.problem.residual, c.draws, Eigen::MatrixXd(n, 0));
  diagnosis.p_gap = gap.p;
  c.scan = gap.scan_tail;
  diagnosis.where = locate(c.shapes.strata, c.shapes.stratum_columns, c.shapes.stratum_dof, c.problem.residual,
                           gap.scan_tail, settings.p_confirmation);

  const std::vector<Hypothesis> hypotheses = screened(c);
  const std::vector<Refit> all = fits(c, hypotheses);
  std::vector<Option> options = options_of(c, all);
  add_unfitted(c, hypotheses, all, options);
  std::optional<Choice> choice = choose(c, all);
  const Refit& fit =
      choice ? choice->fit
             : *std::find_if(all.begin(), all.end(), [](const Refit& f) { return f.hypothesis.effects.empty(); });
  const Eigen::MatrixXd explained = orthonormal(fit.jacobian);
  Eigen::VectorXd left = c.problem.residual - fit.prediction;
  if (explained.cols() > 0) left -= explained * (explained.transpose() * left);
  const double p_rest = choice ? gap_test(c.shapes, left, c.draws, explained).p : gap.p;
  const bool is_rest = p_rest < settings.p_gap;

  if (choice) std::erase_if(options, [](const Option& o) { return o.effects.empty() && !o.has_unknown; });  // rejected
  if (!is_rest) std::erase_if(options, [](const Option& o) { return o.has_unknown; });
  const AmbiguitySet set = ambiguity_set(options, settings.delta);
  diagnosis.ambiguity_set = explanations(evidence, set);
  const auto& likeliest = set.classes.front();
  if (is_rest) {
    const bool adds = choice && log_posterior(options, fit.hypothesis.effects, true) >
                                    log_posterior(options, {}, true) + kNamedBesideUnknown;
    diagnosis.verdict = adds ? Verdict::named_and_unknown : Verdict::unknown;
  } else if (!choice) {
    // What no test singles out may still be needed: then nothing at all is no explanation any more.
    diagnosis.verdict = !evidence.mistakes.empty() ? Verdict::named
                        : holds_nothing(set)       ? Verdict::none
                                                   : Verdict::ambiguous;
  } else {
    const bool is_first = likeliest.front().effects == fit.hypothesis.effects;
    diagnosis.verdict = is_first && all_name_the_same(evidence, set) ? Verdict::named : Verdict::ambiguous;
  }
  if (is_rest) diagnosis.unknown = describe_unknown(evidence, c.covariance, c.problem, c.shapes, left, explained);
  diagnosis.unknown.p = p_rest;

  measure_gaps(c, fit, diagnosis);
  diagnosis.upper_limits = upper_limits(evidence, c.problem, fit.hypothesis.effects, left, explained,
                                        c.discovery.quantile(settings.p_discovery));
  if (choice && diagnosis.verdict != Verdict::unknown) {
    add_parameters(c, *choice);
    diagnosis.effects = choice->effects;
    diagnosis.parameter_covariance = covariance_in_units(c, *choice);
  }
  if (designs && (diagnosis.verdict == Verdict::ambiguous || diagnosis.verdict == Verdict::none))
    diagnosis.next = next_measurements(evidence, c.covariance, designs, set);
  return diagnosis;
}

}  // namespace fathom
