#include "diagnosis/predict/physics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <tuple>

#include "core/units.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

constexpr std::array<std::string_view, 2> kOfPlacements{"height_mm", "desk_height_mm"};
constexpr std::array<std::string_view, 5> kOfSessions{"desk_pitch_deg", "desk_roll_deg", "desk_residual_mm",
                                                      "comb_strength", "millimetre_comb"};

/// The desk stays where it is: how it lies and looks says the same in every placement of a session, with the same
/// errors, so that one of each is enough; its height may drift.
class PredictedRows {
 public:
  bool operator()(const Observation& observation) {
    const auto is_in = [&](const auto& names) {
      return std::find(names.begin(), names.end(), observation.observable) != names.end();
    };
    const Factors& f = observation.factors;
    if (is_in(kOfSessions))
      return seen_.emplace(f.session, f.liquid == "none", observation.observable, f.region).second;
    return is_in(kOfPlacements);
  }

 private:
  std::set<std::tuple<int, bool, std::string, std::string>> seen_;
};

std::vector<Observation> predicted_observations(const Measurement& measurement, const Json& model_effects,
                                                const std::string& file) {
  std::vector<Observation> candidates;
  PredictedRows is_predicted;
  for (const Observation& observation : measurement.observations)
    if (is_predicted(observation)) candidates.push_back(observation);
  const Predictor predictor(measurement.rig, candidates, model_effects, file);
  const Eigen::VectorXd nominal = predictor.predict({});
  const std::vector<bool> near_shadows = predictor.near_shadows();
  std::vector<Observation> predicted;
  for (std::size_t row = 0; row < candidates.size(); ++row)
    if (std::isfinite(nominal[row]) && !near_shadows[row]) predicted.push_back(std::move(candidates[row]));
  return predicted;
}

/// What some hundred rays and the law's mean are off against a whole frame whose noise dithers the law.
Eigen::VectorXd numerical_errors(const std::vector<Observation>& observations) {
  constexpr double kLength_mm = 0.05, kAngle_deg = 0.003, kShare = 0.02;
  Eigen::VectorXd errors(static_cast<Eigen::Index>(observations.size()));
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const std::string& name = observations[i].observable;
    errors[static_cast<Eigen::Index>(i)] = name.ends_with("_mm")    ? kLength_mm
                                           : name.ends_with("_deg") ? kAngle_deg
                                                                    : kShare;
  }
  return errors;
}

/// Change per unit between two set-ups `low` and `high` of one quantity; 0 where either sees nothing.
Eigen::VectorXd slope(const Predictor& predictor, const std::function<Change(double)>& at, double low, double high,
                      const std::vector<std::size_t>& conditions) {
  Eigen::VectorXd difference =
      (predictor.predict(at(high), conditions) - predictor.predict(at(low), conditions)) / (high - low);
  for (double& value : difference)
    if (!std::isfinite(value)) value = 0.0;
  return difference;
}

std::vector<std::size_t> conditions_where(const Predictor& predictor, const std::function<bool(const Factors&)>& is) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < predictor.conditions().size(); ++i)
    if (is(predictor.conditions()[i].factors)) found.push_back(i);
  return found;
}

bool has_cup(const Factors& factors) { return factors.liquid != "none"; }
bool has_liquid(const Factors& factors) { return has_cup(factors) && factors.liquid != "empty"; }

/// A value of the rig, moved by the effect that is an error of it.
struct UncertainValue {
  const char* key;     ///< of the rig's sigma
  const char* effect;  ///< with one parameter, in the key's unit
  double sigma;        ///< when the rig has none
};
constexpr std::array kUncertain{UncertainValue{"height_mm", "sensor_height", 0.5},
                                UncertainValue{"pitch_deg", "sensor_pitch", 0.05},
                                UncertainValue{"roll_deg", "sensor_roll", 0.05},
                                UncertainValue{"baseline_mm", "baseline", 0.05},
                                UncertainValue{"focal_px", "focal_length", 0.4},
                                UncertainValue{"disparity_offset_px", "disparity_offset", 0.02},
                                UncertainValue{"bottom_mm", "cup_bottom_height", 0.1}};

std::vector<Nuisance> rig_nuisances(const Predictor& predictor) {
  const auto all = conditions_where(predictor, [](const Factors&) { return true; });
  const std::map<std::string, double>& sigmas = predictor.model().laboratory.sigma;
  std::vector<Nuisance> nuisances;
  for (const UncertainValue& value : kUncertain) {
    const auto given = sigmas.find(value.key);
    const double sigma = given != sigmas.end() ? given->second : value.sigma;
    if (sigma <= 0.0) continue;
    const auto at = [&](double x) { return switch_on({{value.effect, {x}}}); };
    nuisances.push_back({value.key, sigma, slope(predictor, at, -sigma, sigma, all)});
  }
  return nuisances;
}

/// A device that matches has averaged over its windows, a capture without images has not: both are taken for right.
Nuisance window_nuisance(const Predictor& predictor) {
  constexpr double kWindow_px = 9.0;
  const auto all = conditions_where(predictor, [](const Factors&) { return true; });
  const auto at = [](double x) { return switch_on({{"window_averaging", {x}}}); };
  return {"matching window", kWindow_px, slope(predictor, at, 1.0, kWindow_px, all)};
}

/// A sensor that is set up anew stands and looks a little otherwise: by a part of what its pose is uncertain anyway.
std::vector<Nuisance> session_nuisances(const std::vector<Nuisance>& of_rig,
                                        const std::vector<Observation>& observations) {
  constexpr double kPart = 0.4;
  std::set<int> sessions;
  for (const Observation& observation : observations) sessions.insert(observation.factors.session);
  std::vector<Nuisance> nuisances;
  if (sessions.size() < 2) return nuisances;
  for (const Nuisance& rig : of_rig) {
    if (rig.name != "height_mm" && rig.name != "pitch_deg" && rig.name != "roll_deg") continue;
    for (const int session : sessions) {
      Nuisance own{fmt::format("{} of session {}", rig.name, session), kPart * rig.sigma, rig.signature};
      for (std::size_t row = 0; row < observations.size(); ++row)
        if (observations[row].factors.session != session) own.signature[static_cast<Eigen::Index>(row)] = 0.0;
      nuisances.push_back(std::move(own));
    }
  }
  return nuisances;
}

std::vector<Nuisance> fill_nuisances(const Predictor& predictor) {
  const double sigma_mm = mm_from_metres(predictor.model().laboratory.fill_sigma_m);
  std::set<std::pair<int, int>> pours;
  for (const Condition& condition : predictor.conditions())
    if (has_liquid(condition.factors)) pours.emplace(condition.factors.session, condition.factors.pour);
  std::vector<Nuisance> nuisances;
  if (sigma_mm <= 0.0) return nuisances;
  const auto at = [](double x) { return switch_on({{"fill_offset", {x}}}); };
  for (const auto& [session, pour] : pours) {
    const auto of_pour = conditions_where(predictor, [session = session, pour = pour](const Factors& f) {
      return has_liquid(f) && f.session == session && f.pour == pour;
    });
    nuisances.push_back({"fill of pour " + std::to_string(session) + "/" + std::to_string(pour), sigma_mm,
                         slope(predictor, at, -sigma_mm, sigma_mm, of_pour)});
  }
  return nuisances;
}

std::vector<Nuisance> place_nuisances(const Predictor& predictor) {
  const double sigma_mm = mm_from_metres(predictor.model().laboratory.placement_sigma_m);
  std::vector<Nuisance> nuisances;
  if (sigma_mm <= 0.0) return nuisances;
  const auto along = [](int axis) {
    return [axis](double x) {
      return switch_on({{"cup_placement", axis == 0 ? std::vector{x, 0.0} : std::vector{0.0, x}}});
    };
  };
  const auto with_cup = conditions_where(predictor, has_cup);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::VectorXd all = slope(predictor, along(axis), -sigma_mm, sigma_mm, with_cup);
    for (const std::size_t i : with_cup) {
      const Condition& condition = predictor.conditions()[i];
      Eigen::VectorXd own = Eigen::VectorXd::Zero(all.size());
      for (const std::size_t row : condition.rows) own[row] = all[row];
      nuisances.push_back({(axis == 0 ? "x of placement " : "y of placement ") +
                               std::to_string(condition.factors.session) + "/" +
                               std::to_string(condition.factors.placement),
                           sigma_mm, std::move(own)});
    }
  }
  return nuisances;
}

/// Which observations have the same error of the model, beside being of one observable and region.
enum class SharedBy { all, session, place, liquid, condition };

/// What few rays and direct light leave out of an observable (see surrogate.h and its test).
struct ModelError {
  std::string_view observable;
  double sigma;
  SharedBy shared_by;
};
constexpr std::array kModelErrors{
    ModelError{"height_mm", 0.05, SharedBy::liquid},      // against whole frames
    ModelError{"height_mm", 0.10, SharedBy::condition},   // matching: the same dots fall the same way each time
    ModelError{"desk_height_mm", 0.05, SharedBy::all},    // against whole frames, as the next two
    ModelError{"desk_height_mm", 0.10, SharedBy::place},  // a cup hides what the plane was fitted to
    ModelError{"desk_pitch_deg", 0.02, SharedBy::all},       ModelError{"desk_roll_deg", 0.02, SharedBy::all},
    ModelError{"desk_residual_mm", 0.10, SharedBy::all},      // a matcher's bias by place; a Kinect has -0.3 to 0.7 mm
    ModelError{"desk_residual_mm", 0.10, SharedBy::session},  // the same, as the dots fall that day
    ModelError{"comb_strength", 0.10, SharedBy::session},     // depths are no even mixture of steps
    ModelError{"millimetre_comb", 0.02, SharedBy::all}};

std::string shared_key(const Factors& f, SharedBy shared_by) {
  std::string key = f.region;
  if (shared_by == SharedBy::session) return key + fmt::format(", session {}", f.session);
  if (shared_by == SharedBy::place) return key + fmt::format(", cup at ({:g}, {:g}) mm", f.lateral_mm, f.distance_mm);
  if (shared_by != SharedBy::all) key += " of " + f.liquid;
  if (shared_by == SharedBy::condition)
    key += fmt::format(", {:g} mm, at ({:g}, {:g}) mm", f.fill_mm, f.lateral_mm, f.distance_mm);
  return key;
}

std::vector<Nuisance> model_errors(const std::vector<Observation>& observations) {
  std::vector<Nuisance> nuisances;
  for (const ModelError& error : kModelErrors) {
    std::map<std::string, Eigen::VectorXd> rows;
    for (std::size_t row = 0; row < observations.size(); ++row) {
      const Observation& o = observations[row];
      if (o.observable != error.observable) continue;
      Eigen::VectorXd& own = rows[shared_key(o.factors, error.shared_by)];
      if (own.size() == 0) own = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.size()));
      own[static_cast<Eigen::Index>(row)] = 1.0;
    }
    for (auto& [name, signature] : rows)
      nuisances.push_back(
          {"model of " + std::string(error.observable) + ", " + name, error.sigma, std::move(signature)});
  }
  return nuisances;
}

Candidate candidate_of(const Predictor& predictor, const Effect& effect, const std::string& liquid) {
  const auto touched = conditions_where(predictor, [&](const Factors& f) {
    return liquid.empty() ? !effect.of_liquids || has_liquid(f) : f.liquid == liquid;
  });
  Candidate candidate;
  candidate.effect = std::string(effect.id) + (liquid.empty() ? "" : "@" + liquid);
  const std::size_t count = effect.parameters.size();
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t i = 0; i < count; ++i) {
    const EffectParameter& p = effect.parameters[i];
    candidate.parameters.push_back({std::string(p.name), p.nominal, p.scale, p.lower, p.upper});
    const auto at = [&](double x) {
      std::vector<double> values;
      for (const EffectParameter& parameter : effect.parameters) values.push_back(parameter.nominal);
      values[i] = x;
      return switch_on({{candidate.effect, values}});
    };
    columns.push_back(
        slope(predictor, at, std::max(p.nominal - p.scale, p.lower), std::min(p.nominal + p.scale, p.upper), touched));
  }
  candidate.signature.resize(columns.front().size(), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) candidate.signature.col(static_cast<Eigen::Index>(i)) = columns[i];
  return candidate;
}

/// A wrong unit is a fill_scale until its factor is a unit's, which the statistics' hygiene looks for; the matcher's
/// window is a nuisance.
constexpr std::array<std::string_view, 2> kNotCandidates{"unit_error", "window_averaging"};

std::vector<std::string> poured_liquids(const Predictor& predictor) {
  std::set<std::string> liquids;
  for (const Condition& condition : predictor.conditions())
    if (has_liquid(condition.factors)) liquids.insert(condition.factors.liquid);
  return {liquids.begin(), liquids.end()};
}

/// What moves every row by less than this at its prior scale moves nothing that could be measured.
bool moves_anything(const Candidate& candidate) {
  constexpr double kNothing = 1e-4;  // [mm or °]
  double most = 0.0;
  for (std::size_t i = 0; i < candidate.parameters.size(); ++i)
    most = std::max(most, candidate.parameters[i].prior_scale *
                              candidate.signature.col(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff());
  return most > kNothing;
}

}  // namespace

Physics physics_of(const Measurement& measurement, const Json& model_effects, const std::string& file) {
  Physics physics;
  Evidence& evidence = physics.evidence;
  evidence.observations = predicted_observations(measurement, model_effects, file);
  const auto predictor = std::make_shared<const Predictor>(measurement.rig, evidence.observations, model_effects, file);
  evidence.predicted = predictor->predict({});
  evidence.numerical_sd = numerical_errors(evidence.observations);
  for (const auto nuisances : {rig_nuisances, fill_nuisances, place_nuisances})
    for (Nuisance& nuisance : nuisances(*predictor)) evidence.nuisances.push_back(std::move(nuisance));
  evidence.nuisances.push_back(window_nuisance(*predictor));
  for (Nuisance& nuisance : session_nuisances(evidence.nuisances, evidence.observations))
    evidence.nuisances.push_back(std::move(nuisance));
  for (Nuisance& nuisance : model_errors(evidence.observations)) evidence.nuisances.push_back(std::move(nuisance));
  const std::vector<std::string> liquids = poured_liquids(*predictor);
  for (const Effect& effect : effect_registry()) {
    if (std::find(kNotCandidates.begin(), kNotCandidates.end(), effect.id) != kNotCandidates.end()) {
      physics.unseen.emplace_back(effect.id);
      continue;
    }
    std::vector<std::string> targets{""};
    if (effect.of_liquids && liquids.size() > 1) targets.insert(targets.end(), liquids.begin(), liquids.end());
    for (const std::string& liquid : targets) {
      Candidate candidate = candidate_of(*predictor, effect, liquid);
      if (evidence.predicted.size() > 0 && moves_anything(candidate))
        evidence.candidates.push_back(std::move(candidate));
      else if (liquid.empty())
        physics.unseen.emplace_back(effect.id);
    }
  }
  physics.predict = [predictor, nominal = evidence.predicted](const std::vector<EffectValue>& effects) {
    Eigen::VectorXd values = predictor->predict(switch_on(effects));
    for (Eigen::Index row = 0; row < values.size(); ++row)
      if (!std::isfinite(values[row])) values[row] = nominal[row];
    return values;
  };
  return physics;
}

}  // namespace fathom
