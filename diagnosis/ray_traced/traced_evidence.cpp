#include "diagnosis/ray_traced/traced_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "diagnosis/ray_traced/local_model.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {
namespace {

constexpr int kRounds = 2;            // of Gauss and Newton
constexpr double kMovedLittle = 0.1;  // of the reach of slopes

std::vector<int> numbers_of(const Evidence& evidence, const std::vector<std::string>& set) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < evidence.candidates.size(); ++i)
    if (std::find(set.begin(), set.end(), evidence.candidates[i].effect) != set.end())
      numbers.push_back(static_cast<int>(i));
  return numbers;
}

/// All that is traced, of all rows of the physics.
struct Traced {
  const Physics& physics;
  RayTracer& tracer;
  std::vector<LocalModel> models;

  Predict ask() const {
    return [this](const std::vector<EffectValue>& effects) { return tracer.predict(effects); };
  }

  /// Effects switched on; NaN where frames show nothing.
  Eigen::VectorXd predict(const std::vector<EffectValue>& effects) const {
    const Eigen::VectorXd& nominal = tracer.predict({});
    for (const LocalModel& model : models)
      if (is_seen(model) && is_of(model, effects)) {
        Eigen::VectorXd values = model(parameters_of(physics.evidence, model.effects, effects));
        for (Eigen::Index row = 0; row < values.size(); ++row)
          if (!std::isfinite(values[row])) values[row] = nominal[row];
        return values;
      }
    return nominal + (physics.predict(effects) - physics.evidence.predicted);
  }

  /// Whether frames show the set at all: the paper's reduction, for one, is of tables, not of clouds.
  static bool is_seen(const LocalModel& model) { return !model.slopes.isZero(0.0); }

 private:
  bool is_of(const LocalModel& model, const std::vector<EffectValue>& effects) const {
    return std::equal(model.effects.begin(), model.effects.end(), effects.begin(), effects.end(),
                      [&](int number, const EffectValue& value) {
                        return physics.evidence.candidates[number].effect == value.effect;
                      });
  }
};

/// Where few rays would have the set; what they do not see starts a prior scale off nominal, what is about light half
/// of one, whatever they say.
Eigen::VectorXd start_of(const Physics& physics, const Covariance& covariance, const Problem& problem,
                         const std::vector<int>& effects) {
  const auto count = static_cast<Eigen::Index>(columns_of(problem, effects).size());
  const Refit fit =
      refit(physics.evidence, physics.predict, covariance, problem, {effects, Eigen::VectorXd::Zero(count), 0.0, 0.0});
  Eigen::VectorXd start = fit.hypothesis.parameters;
  Eigen::Index next = 0;
  for (const int effect : effects) {
    const Candidate& candidate = physics.evidence.candidates[effect];
    const bool is_light = brings_light(*physics.predictor, candidate);
    for (Eigen::Index k = 0; k < candidate.sensitivity.cols(); ++k, ++next)
      if (candidate.sensitivity.col(k).isZero(0.0))
        start[next] = 1.0;
      else if (is_light || start[next] == 0.0)
        start[next] = 0.5;
  }
  return start;
}

/// Sensitivities with which the change from nominal is exact where the model is local: its slopes and the least that
/// makes them so (Broyden 1965).
Eigen::MatrixXd sensitivities_of(const LocalModel& model, const Eigen::VectorXd& nominal) {
  const double length2 = model.at.squaredNorm();
  if (length2 < 1e-12) return model.slopes;
  Eigen::VectorXd missing = model.there - nominal - model.slopes * model.at;
  missing = missing.unaryExpr([](double value) { return std::isfinite(value) ? value : 0.0; });
  return model.slopes + missing * model.at.transpose() / length2;
}

/// Images have all light or none: what few rays do not see is taken to grow evenly from nominal to a prior scale.
LocalModel traced_model(const Traced& traced, const std::vector<int>& effects, const Eigen::VectorXd& at) {
  const Evidence& evidence = traced.physics.evidence;
  const bool is_seen = std::any_of(effects.begin(), effects.end(),
                                   [&](int effect) { return !evidence.candidates[effect].sensitivity.isZero(0.0); });
  if (is_seen) return local_model(evidence, effects, at, traced.ask());
  LocalModel model{effects,
                   at,
                   Eigen::VectorXd::Constant(at.size(), std::numeric_limits<double>::infinity()),
                   traced.tracer.predict(effect_values(evidence, effects, at)),
                   {}};
  model.slopes = Eigen::MatrixXd::Zero(model.there.size(), at.size());
  model.slopes = sensitivities_of(model, traced.tracer.predict({}));
  return model;
}

std::vector<Eigen::Index> rows_seen(const Traced& traced) {
  const Eigen::VectorXd& nominal = traced.tracer.predict({});
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < nominal.size(); ++row)
    if (std::isfinite(nominal[row]) && (traced.models.empty() || std::isfinite(traced.models.front().there[row])))
      rows.push_back(row);
  return rows;
}

/// Of the rows seen; with the sensitivities of what was traced.
Evidence evidence_by_tracing(const Traced& traced, const std::vector<Eigen::Index>& rows) {
  const Eigen::VectorXd& nominal = traced.tracer.predict({});
  Evidence evidence = traced.physics.evidence;
  evidence.predicted = nominal;
  std::vector<bool> is_traced(evidence.candidates.size(), false);
  for (const LocalModel& model : traced.models) {
    if (!Traced::is_seen(model)) continue;
    const Eigen::MatrixXd sensitivities = sensitivities_of(model, nominal);
    Eigen::Index next = 0;
    for (const int effect : model.effects) {
      Candidate& candidate = evidence.candidates[effect];
      const auto count = static_cast<Eigen::Index>(candidate.parameters.size());
      for (Eigen::Index k = 0; k < count && !is_traced[effect]; ++k)
        candidate.sensitivity.col(k) = sensitivities.col(next + k) / candidate.parameters[k].prior_scale;
      is_traced[effect] = true;
      next += count;
    }
  }
  return evidence_of_rows(evidence, rows);
}

/// Whether any model is elsewhere now.
bool move_to_fit(const Evidence& evidence, const Predict& predict, Traced& traced) {
  const Covariance covariance = estimate_covariance(evidence, measured_minus_predicted(evidence));
  const Problem problem = whitened_problem(evidence, covariance);
  bool moved = false;
  for (LocalModel& model : traced.models) {
    const Refit fit = refit(evidence, predict, covariance, problem, {model.effects, model.at, 0.0, 0.0});
    const Eigen::VectorXd& at = fit.hypothesis.parameters;
    const double far = (at - model.at).cwiseAbs().cwiseQuotient(model.reach).maxCoeff();
    if (far < kMovedLittle) continue;
    moved = true;
    if (far > 1.0) {
      model = traced_model(traced, model.effects, at);
    } else {
      model.there = traced.tracer.predict(effect_values(traced.physics.evidence, model.effects, at));
      model.at = at;
    }
  }
  return moved;
}

double cosine(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const double lengths = a.norm() * b.norm();
  return lengths > 0.0 ? a.dot(b) / lengths : 0.0;
}

/// Both by the same differences, whitened alike.
TracedSet checked(const Traced& traced, const LocalModel& model, const std::vector<Eigen::Index>& rows,
                  const Covariance& covariance) {
  const LocalModel few = local_model(traced.physics.evidence, model.effects, model.at, traced.physics.predict);
  const Eigen::MatrixXd by_few = covariance.whiten(few.slopes(rows, Eigen::all)),
                        by_frames = covariance.whiten(model.slopes(rows, Eigen::all));
  TracedSet set;
  Eigen::Index next = 0;
  for (const int effect : model.effects) {
    const Candidate& candidate = traced.physics.evidence.candidates[effect];
    SensitivityCheck check{candidate.effect, 1.0};
    for (std::size_t k = 0; k < candidate.parameters.size(); ++k, ++next)
      check.cosine = std::min(check.cosine, cosine(by_few.col(next), by_frames.col(next)));
    set.effects.push_back(candidate.effect);
    set.checks.push_back(std::move(check));
  }
  return set;
}

}  // namespace

RayTracedEvidence ray_traced_evidence(const Physics& physics, const std::vector<std::vector<std::string>>& sets,
                                      RayTracer& tracer) {
  const auto traced = std::make_shared<Traced>(Traced{physics, tracer, {}});
  const Covariance before = estimate_covariance(physics.evidence, measured_minus_predicted(physics.evidence));
  const Problem problem = whitened_problem(physics.evidence, before);
  for (const std::vector<std::string>& set : sets) {
    const std::vector<int> effects = numbers_of(physics.evidence, set);
    traced->models.push_back(traced_model(*traced, effects, start_of(physics, before, problem, effects)));
  }
  RayTracedEvidence result;
  const std::vector<Eigen::Index> rows = rows_seen(*traced);
  result.predict = [traced, rows](const std::vector<EffectValue>& effects) {
    return Eigen::VectorXd(traced->predict(effects)(rows));
  };
  result.evidence = evidence_by_tracing(*traced, rows);
  for (int round = 0; round < kRounds && move_to_fit(result.evidence, result.predict, *traced); ++round)
    result.evidence = evidence_by_tracing(*traced, rows);
  result.by_few_rays = physics.evidence.predicted(rows);
  result.not_seen = physics.evidence.observations.size() - rows.size();
  const Covariance covariance = estimate_covariance(result.evidence, measured_minus_predicted(result.evidence));
  for (const LocalModel& model : traced->models) result.sets.push_back(checked(*traced, model, rows, covariance));
  return result;
}

}  // namespace fathom
