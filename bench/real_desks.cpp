#include "bench/real_desks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "bench/desk_rows.h"
#include "bench/sensor_scenes.h"
#include "diagnosis/decision/decide.h"
#include "diagnosis/predict/candidates.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

/// Which may be mistaken for them.
constexpr const char* kRivals[] = {"disparity_offset", "radial_distortion"};

/// What a model of the device's noise by statistics is known to be off by (scripts/bench accuracy), 1 σ; shadows are of
/// other things. A unit's bias of place is one draw of a field: units differ (unit_spread).
struct TwinError {
  const char* observable;
  double sigma;
};
constexpr TwinError kTwinErrors[] = {{"sigma_steps", 0.07},
                                     {"correlation", 0.06},
                                     {"comb_strength", 0.10},
                                     {"millimetre_comb", 0.02},
                                     {"shadow_share", 0.08}};

/// The Kinect over such a desk, with things that throw shadows.
Setup whole_twin() {
  Setup twin = desk_twin(R"(, "cups": [{"shape": "mug", "position_mm": [-170, 800]},
                              {"shape": "paper_cup", "position_mm": [0, 900]}, {"shape": "mug", "position_mm": [180, 750]}])");
  twin.processing.colour_view = true;
  return twin;
}

Setup twin_without(const std::string& effect) {
  Setup twin = whole_twin();
  SensorModel& sensor = twin.rig.sensor;
  if (effect == "depth_quantization") sensor.law.quantized = false;
  if (effect == "depth_step_phase") sensor.law.step_phase = 0.0;
  if (effect == "depth_truncation") sensor.law.cut = 0.0;
  if (effect == "noise_correlation") sensor.matcher.window_columns = sensor.matcher.window_rows = 1;
  if (effect == "reference_residue") sensor.unit.residue_px = 0.0;
  if (effect == "colour_registration") twin.processing.colour_view = false;
  return twin;
}

using RowKey = std::tuple<std::string, std::string, double>;
std::map<RowKey, double> rows_of(const Setup& setup) {
  constexpr std::uint64_t kSeed = 1;  // the same noise for all effects and units
  std::map<RowKey, double> values;
  const auto image = with_desk("twin", shoot(setup, kSeed, CaptureMode::geometric).depth);
  if (!image) return values;
  for (const DeskRow& row : desk_rows(setup.rig.sensor, *image))
    values[{row.observable, row.region, row.distance_mm}] = row.value;
  return values;
}

/// 1 σ of each row of bias, unit to unit.
std::map<RowKey, double> unit_spread() {
  constexpr int kUnits = 8;
  std::map<RowKey, std::vector<double>> values;
  for (int serial = 1; serial <= kUnits; ++serial) {
    Setup twin = whole_twin();
    twin.rig.sensor.unit.serial = static_cast<std::uint64_t>(serial);
    for (const auto& [key, value] : rows_of(twin))
      if (std::get<0>(key).ends_with("bias_mm")) values[key].push_back(value);
  }
  std::map<RowKey, double> spread;
  for (const auto& [key, all] : values) {
    const Eigen::Map<const Eigen::ArrayXd> units(all.data(), static_cast<Eigen::Index>(all.size()));
    const double freedom = static_cast<double>(all.size()) - 1.0;
    if (freedom > 0.0) spread[key] = std::sqrt((units - units.mean()).square().sum() / freedom);
  }
  return spread;
}

/// Rows of the observations as the twin has them; each set of effects is shot once.
class TwinPredictor {
 public:
  TwinPredictor(Setup twin, std::vector<RowKey> keys) : twin_(std::move(twin)), keys_(std::move(keys)) {}

  Eigen::VectorXd operator()(const std::vector<EffectValue>& effects) {
    Setup setup = twin_;
    for (const EffectValue& value : effects) {
      const Effect& effect = *find_effect(value.effect);
      std::vector<double> values = value.values;
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::clamp(values[i], effect.parameters[i].lower, effect.parameters[i].upper);
      effect.apply(setup, {values});
    }
    const std::map<RowKey, double> seen = rows_of(setup);
    Eigen::VectorXd predicted(static_cast<Eigen::Index>(keys_.size()));
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const auto found = seen.find(keys_[i]);
      predicted[static_cast<Eigen::Index>(i)] =
          found != seen.end() ? found->second : (nominal_.size() > 0 ? nominal_[static_cast<Eigen::Index>(i)] : NAN);
    }
    if (nominal_.size() == 0) nominal_ = predicted;
    return predicted;
  }

 private:
  Setup twin_;
  std::vector<RowKey> keys_;
  Eigen::VectorXd nominal_;
};

Candidate candidate_of(const Effect& effect, TwinPredictor& predict) {
  const auto slope = [&](const std::function<EffectValue(double)>& at, double low, double high) {
    const Eigen::VectorXd at_high = predict({at(high)}), at_low = predict({at(low)});
    return Eigen::VectorXd((at_high - at_low) / (high - low));
  };
  return candidate_by_slopes(effect, std::string(effect.id), slope);
}

RowKey key_of(const Observation& o) { return {o.observable, o.factors.region, o.factors.distance_mm}; }

/// What all desks share of the twin's error: of each row, and of one region at all distances.
std::vector<Nuisance> twin_errors(const std::vector<Observation>& observations) {
  std::vector<Nuisance> nuisances;
  for (const auto& [key, sigma] : unit_spread()) {
    Eigen::VectorXd row(static_cast<Eigen::Index>(observations.size()));
    for (std::size_t i = 0; i < observations.size(); ++i)
      row[static_cast<Eigen::Index>(i)] = key_of(observations[i]) == key;
    nuisances.push_back({std::get<0>(key) + " of the unit at " + std::to_string(std::lround(std::get<2>(key))) + " mm",
                         sigma, std::move(row)});
  }
  for (const TwinError& error : kTwinErrors)
    for (const bool at_all_distances : {true, false}) {
      std::map<std::pair<std::string, double>, Eigen::VectorXd> groups;
      for (std::size_t row = 0; row < observations.size(); ++row) {
        const Observation& o = observations[row];
        if (o.observable != error.observable) continue;
        Eigen::VectorXd& group = groups[{o.factors.region, at_all_distances ? 0.0 : o.factors.distance_mm}];
        if (group.size() == 0) group = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.size()));
        group[static_cast<Eigen::Index>(row)] = 1.0;
      }
      for (auto& [key, sensitivity] : groups)
        nuisances.push_back({std::string(error.observable) + " of the twin, " + key.first + " at " +
                                 std::to_string(std::lround(key.second)) + " mm",
                             error.sigma / std::sqrt(2.0), std::move(sensitivity)});
    }
  return nuisances;
}

double rms_in_errors(const std::vector<double>& residual, const std::vector<double>& error) {
  double squares = 0.0;
  for (std::size_t i = 0; i < residual.size(); ++i) squares += std::pow(residual[i] / error[i], 2.0);
  return std::sqrt(squares / static_cast<double>(residual.size()));
}

std::vector<Observation> measured_rows(const SensorModel& sensor, const std::vector<DeskImage>& desks,
                                       const std::map<RowKey, double>& of_twin) {
  std::vector<Observation> observations;
  for (std::size_t i = 0; i < desks.size(); ++i)
    for (const DeskRow& row : desk_rows(sensor, desks[i])) {
      if (!of_twin.contains({row.observable, row.region, row.distance_mm})) continue;
      Observation& observation = observations.emplace_back();
      observation.observable = row.observable;
      observation.value = row.value;
      observation.factors.placement = static_cast<int>(i);
      observation.factors.liquid = "none";
      observation.factors.distance_mm = row.distance_mm;
      observation.factors.region = row.region;
    }
  return observations;
}

}  // namespace

const std::vector<std::string>& known_of_desks() {
  static const std::vector<std::string> known{"depth_quantization", "depth_step_phase",  "depth_truncation",
                                              "noise_correlation",  "reference_residue", "colour_registration"};
  return known;
}

std::optional<DeskDiagnosis> diagnose_desks(const std::string& without) {
  const std::vector<DeskImage> desks = measured_desks();
  if (desks.empty()) return std::nullopt;
  const Setup twin = twin_without(without);
  Evidence evidence;
  evidence.observations = measured_rows(twin.rig.sensor, desks, rows_of(twin));
  std::vector<RowKey> keys;
  for (const Observation& o : evidence.observations) keys.push_back(key_of(o));
  const auto predict = std::make_shared<TwinPredictor>(twin, keys);
  evidence.predicted = (*predict)({});
  evidence.numerical_sd = Eigen::VectorXd::Constant(evidence.predicted.size(), 0.01);
  evidence.nuisances = twin_errors(evidence.observations);
  for (const std::string& id : known_of_desks())
    evidence.candidates.push_back(candidate_of(*find_effect(id), *predict));
  for (const char* id : kRivals) evidence.candidates.push_back(candidate_of(*find_effect(id), *predict));
  std::erase_if(evidence.candidates, [](const Candidate& c) { return c.sensitivity.cwiseAbs().maxCoeff() < 1e-9; });
  DeskDiagnosis result;
  result.diagnosis = decide(evidence, [predict](const std::vector<EffectValue>& e) { return (*predict)(e); });
  if (result.diagnosis.verdict == Verdict::insufficient) return result;
  result.before = rms_in_errors(result.diagnosis.residuals.before, result.diagnosis.residuals.error);
  result.after = rms_in_errors(result.diagnosis.residuals.after, result.diagnosis.residuals.error);
  return result;
}

}  // namespace fathom
