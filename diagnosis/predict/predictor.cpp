#include "diagnosis/predict/predictor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "core/units.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/statistics/effect_name.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

using ConditionKey = std::tuple<int, int, int, std::string, double, double, double>;

std::optional<Eigen::Vector2d> place_of(const Factors& factors) {
  if (factors.liquid == "none") return std::nullopt;
  return Eigen::Vector2d(metres_from_mm(factors.lateral_mm), metres_from_mm(factors.distance_mm));
}

std::vector<Condition> conditions_of(const LaboratoryRig& rig, const std::vector<Observation>& observations) {
  std::map<ConditionKey, Condition> found;
  for (std::size_t row = 0; row < observations.size(); ++row) {
    const Factors& f = observations[row].factors;
    Condition& condition = found[{f.session, f.pour, f.placement, f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm}];
    condition.factors = f;
    condition.rows.push_back(row);
  }
  std::vector<Condition> conditions;
  for (auto& [key, condition] : found) {
    condition.factors.region.clear();
    condition.pixels = sample_pixels(rig, place_of(condition.factors));
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

/// A whole interior's mean height, as tables without clouds have it.
double interior_height_mm(const FrameEstimates& estimates) {
  constexpr double kFewest = 10.0;
  return estimates.interior.weight >= kFewest ? mm_from_metres(estimates.interior.mean)
                                              : std::numeric_limits<double>::quiet_NaN();
}

/// 1 σ of the desk's height when all disparities of a frame share an error: 1/z changes by it over f b, everywhere.
double wander_mm(const SensorModel& sensor, const Plane& desk) {
  const Calibration believed = sensor.calibration();
  return mm_from_metres(desk.offset * desk.offset * std::abs(desk.normal.z()) * sensor.unit.wander_px /
                        (believed.focal_px * believed.baseline));
}

}  // namespace

Predictor::Predictor(const LaboratoryRig& rig, const std::vector<Observation>& observations, Json model_effects,
                     std::string file)
    : model_(nominal_model(rig, file)),
      model_effects_(std::move(model_effects)),
      file_(std::move(file)),
      conditions_(conditions_of(rig, observations)) {
  for (const Observation& observation : observations) {
    observables_.push_back(observation.observable);
    regions_.push_back(observation.factors.region);
  }
}

Setup Predictor::nominal_setup(const Condition& condition) const {
  Setup setup = setup_of(model_, condition.factors);
  setup.effects = model_effects_;
  setup.file = file_;
  return with_effects(std::move(setup));
}

std::vector<bool> Predictor::near_shadows() const {
  constexpr double kTooMuch = 0.35;  // of a region
  std::vector<bool> shadowed(observables_.size(), false);
  for (const Condition& condition : conditions_) {
    const std::optional<Eigen::Vector2d> place = place_of(condition.factors);
    if (!place) continue;
    const std::array<double, 5> shares =
        shares_near_shadows(nominal_setup(condition), model_.laboratory, *place, condition.pixels);
    for (const std::size_t row : condition.rows)
      for (std::size_t i = 0; i < shares.size(); ++i)
        if (observables_[row] == "height_mm" && regions_[row] == kCupRegionNames[i] && shares[i] > kTooMuch)
          shadowed[row] = true;
  }
  return shadowed;
}

void Predictor::keep(const std::vector<bool>& kept) {
  std::vector<std::size_t> new_row(kept.size());
  std::size_t count = 0;
  for (std::size_t row = 0; row < kept.size(); ++row) {
    if (!kept[row]) continue;
    observables_[count] = observables_[row];
    regions_[count] = regions_[row];
    new_row[row] = count++;
  }
  observables_.resize(count);
  regions_.resize(count);
  for (Condition& condition : conditions_) {
    std::erase_if(condition.rows, [&](std::size_t row) { return !kept[row]; });
    for (std::size_t& row : condition.rows) row = new_row[row];
  }
  std::erase_if(conditions_, [](const Condition& condition) { return condition.rows.empty(); });
}

void Predictor::predict_condition(const Condition& condition, const Change& change, Eigen::VectorXd& values) const {
  Setup setup = nominal_setup(condition);
  if (change) change(setup, condition.factors);
  const auto estimates = surrogate_frame(setup, model_.laboratory, place_of(condition.factors), condition.pixels);
  for (const std::size_t row : condition.rows) values[row] = std::numeric_limits<double>::quiet_NaN();
  if (!estimates) return;
  const std::vector<NamedValue> named = named_values(*estimates);
  for (const std::size_t row : condition.rows) {
    if (observables_[row] == "height_mm" && regions_[row] == kWholeInterior) {
      values[row] = interior_height_mm(*estimates);
      continue;
    }
    if (observables_[row] == "desk_wander_mm") {
      values[row] = wander_mm(setup.rig.sensor, estimates->desk);
      continue;
    }
    for (const NamedValue& value : named)
      if (value.observable == observables_[row] && value.region == regions_[row]) values[row] = value.value;
  }
}

Eigen::VectorXd Predictor::predict(const Change& change, const std::vector<std::size_t>& conditions) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observables_.size()));
  parallel_ranges(static_cast<int>(conditions.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) predict_condition(conditions_[conditions[i]], change, values);
  });
  return values;
}

Eigen::VectorXd Predictor::predict(const Change& change) const {
  std::vector<std::size_t> all(conditions_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return predict(change, all);
}

Change switch_on(const std::vector<EffectValue>& effects) {
  struct On {
    const Effect* effect;
    std::string liquid;
    std::vector<double> values;
  };
  std::vector<On> switched;
  for (const EffectValue& value : effects) {
    EffectName name = effect_name(value.effect);
    const Effect* effect = find_effect(name.id);
    if (!effect) throw Error("effects", unknown_name("effect", value.effect, effect_ids()));
    On on{effect, std::move(name.liquid), value.values};
    on.values.resize(effect->parameters.size());
    for (std::size_t i = 0; i < on.values.size(); ++i)
      on.values[i] = std::clamp(on.values[i], effect->parameters[i].lower, effect->parameters[i].upper);
    switched.push_back(std::move(on));
  }
  return [switched](Setup& setup, const Factors&) {
    for (const On& on : switched) on.effect->apply(setup, {on.values, on.liquid});
  };
}

}  // namespace fathom
