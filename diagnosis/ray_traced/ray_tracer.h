// All observations of a campaign by whole simulated frames: a hundred times as dear as few rays, with all light and all
// that a matcher makes of it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "diagnosis/predict/predictor.h"

namespace fathom {

/// The cloud of a set-up by the whole simulated camera: infrared image, matcher, depth. The points are those of two
/// shots of one scene, each half a pixel of its cloud. The light is that of a measurement (measured_light), the unit
/// one without wander. Equal seeds give equal noise, so that set-ups that differ a little differ in nothing else.
std::vector<SensedPoint> ray_traced_points(const Setup& setup, std::uint64_t seed);

/// A prior scale off nominal.
EffectValue typical_departure(const Candidate& candidate);

/// Whether an effect lets in light that few rays know nothing of.
bool brings_light(const Predictor& predictor, const Candidate& candidate);

class RayTracer {
 public:
  /// `traced` is called after every condition. Equal seeds give equal noise in every prediction.
  RayTracer(std::shared_ptr<const Predictor> predictor, std::uint64_t seed, std::function<void()> traced);

  /// As Predictor::predict() of effects that are switched on. Conditions that they leave as they are, are traced once
  /// for all; what was asked for before is remembered.
  const Eigen::VectorXd& predict(const std::vector<EffectValue>& effects);

  /// What a prediction takes that was not asked for before: conditions that differ, and seconds of processor time, by
  /// and large.
  struct Cost {
    std::size_t conditions = 0;
    double seconds = 0.0;
  };
  Cost cost(const std::vector<EffectValue>& effects) const;

 private:
  /// Those that effects change.
  std::vector<std::size_t> changed(const std::vector<EffectValue>& effects) const;
  Eigen::VectorXd trace(const std::vector<EffectValue>& effects);

  std::shared_ptr<const Predictor> predictor_;
  std::uint64_t seed_;
  std::function<void()> traced_;
  std::map<std::vector<std::pair<std::string, std::vector<double>>>, Eigen::VectorXd> known_;
};

}  // namespace fathom
