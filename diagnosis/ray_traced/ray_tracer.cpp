#include "diagnosis/ray_traced/ray_tracer.h"

#include <algorithm>

#include "core/rng.h"
#include "diagnosis/statistics/evidence.h"
#include "sim/effects/registry.h"
#include "sim/sensor/capture.h"

namespace fathom {
namespace {

constexpr int kShots = 2;

/// `weight`: pixels that each point stands for.
void add_points(const Image<CloudPoint>& cloud, float weight, std::vector<SensedPoint>& points) {
  for (const CloudPoint& p : cloud.pixels())
    if (p.z > 0.0f) points.push_back({{p.x, p.y, p.z}, p.intensity, weight});
}

}  // namespace

std::vector<SensedPoint> ray_traced_points(const Setup& setup, std::uint64_t seed) {
  Setup still = setup;
  still.rig.sensor.unit.wander_px = 0.0;
  Camera camera(still, CaptureMode::photometric, kDefaultSamplesPerPixel, seed, measured_light(still));
  std::vector<SensedPoint> points;
  for (int shot = 0; shot < kShots; ++shot)
    add_points(camera.shoot(static_cast<std::uint64_t>(shot)).cloud, 1.0f / kShots, points);
  return points;
}

EffectValue typical_departure(const Candidate& candidate) {
  EffectValue value{candidate.effect, {}};
  for (const Parameter& parameter : candidate.parameters)
    value.values.push_back(parameter.nominal + parameter.prior_scale);
  return value;
}

bool brings_light(const Predictor& predictor, const Candidate& candidate) {
  const Change change = switch_on({typical_departure(candidate)});
  const auto& conditions = predictor.conditions();
  return std::any_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    return measured_light(predictor.setup(condition, change)) != measured_light(predictor.setup(condition));
  });
}

RayTracer::RayTracer(std::shared_ptr<const Predictor> predictor, std::uint64_t seed, std::function<void()> traced)
    : predictor_(std::move(predictor)), seed_(seed), traced_(std::move(traced)) {}

std::vector<std::size_t> RayTracer::changed(const std::vector<EffectValue>& effects) const {
  const std::size_t count = predictor_->conditions().size();
  std::vector<bool> is_changed(count, effects.empty());
  for (const EffectValue& value : effects) {
    const EffectName name = effect_name(value.effect);
    for (const std::size_t i : conditions_touched(*predictor_, *find_effect(name.id), name.liquid))
      is_changed[i] = true;
  }
  const Change change = switch_on(effects);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < count; ++i) {
    // Light that an effect brings in falls everywhere.
    const Condition& condition = predictor_->conditions()[i];
    if (is_changed[i] ||
        measured_light(predictor_->setup(condition, change)) != measured_light(predictor_->setup(condition)))
      result.push_back(i);
  }
  return result;
}

RayTracer::Cost RayTracer::cost(const std::vector<EffectValue>& effects) const {
  constexpr double kDirect_s = 1.0, kInterreflected_s = 2.0, kScattered_s = 9.0;
  const Change change = switch_on(effects);
  Cost cost;
  for (const std::vector<std::size_t>& group : predictor_->alike(change, changed(effects))) {
    const Setup shot = predictor_->setup(predictor_->conditions()[group.front()], change);
    const bool is_direct = measured_light(shot) == LightModel::direct;
    const bool is_scattered = std::any_of(shot.scene.cups.begin(), shot.scene.cups.end(),
                                          [](const Cup& cup) { return cup.filling && cup.filling->medium.scatters(); });
    ++cost.conditions;
    cost.seconds += is_direct ? kDirect_s : is_scattered ? kScattered_s : kInterreflected_s;
  }
  return cost;
}

Eigen::VectorXd RayTracer::trace(const std::vector<EffectValue>& effects) {
  const Shoot shoot = [this](const Setup& shot, const Condition& condition) {
    std::vector<SensedPoint> points = ray_traced_points(shot, Rng(seed_, condition.equal).bits());
    traced_();
    return points;
  };
  const std::vector<std::size_t> conditions = changed(effects);
  Eigen::VectorXd values = predictor_->predict_by(shoot, switch_on(effects), conditions);
  if (effects.empty()) return values;
  Eigen::VectorXd all = predict({});
  for (const std::size_t i : conditions)
    for (const std::size_t row : predictor_->conditions()[i].rows)
      all[static_cast<Eigen::Index>(row)] = values[static_cast<Eigen::Index>(row)];
  return all;
}

const Eigen::VectorXd& RayTracer::predict(const std::vector<EffectValue>& effects) {
  std::vector<std::pair<std::string, std::vector<double>>> key;
  for (const EffectValue& value : effects) key.emplace_back(value.effect, value.values);
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  return known_.emplace(std::move(key), trace(effects)).first->second;
}

}  // namespace fathom
