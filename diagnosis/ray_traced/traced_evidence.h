// The evidence of a diagnosis once more, by ray tracing: few rays have screened and chosen, whole frames predict.
#pragma once

#include "diagnosis/predict/physics.h"
#include "diagnosis/ray_traced/ray_tracer.h"

namespace fathom {

/// An effect's sensitivity by few rays beside that by whole frames.
struct SensitivityCheck {
  std::string effect;
  double cosine = 0.0;  ///< of the whitened sensitivities, the least of its parameters'; 0 where one of them is none

  /// Whether few rays may stand for it.
  bool is_fit() const { return cosine >= 0.98; }
};

/// A set of effects that was traced.
struct TracedSet {
  std::vector<std::string> effects;
  std::vector<SensitivityCheck> checks;  ///< of each
};

struct RayTracedEvidence {
  Evidence evidence;            ///< of the observations that frames show as well, predicted by them
  Predict predict;              ///< for its rows
  Eigen::VectorXd by_few_rays;  ///< what was predicted of these rows before
  std::vector<TracedSet> sets;  ///< in the order in which they were asked for
  std::size_t not_seen = 0;     ///< observations of which frames show nothing
};

/// Sets of effects (named as by EffectName, each as the diagnosis has them) that are to be traced: near the values that
/// fit the data, found by Gauss and Newton's steps with slopes by central differences. Predictions of all other sets
/// are the traced nominal ones and what few rays make of the change. Sensitivities of effects in traced sets are such
/// that the set's change is exact where it fits. Physics and tracer must outlive the result's predictions.
RayTracedEvidence ray_traced_evidence(const Physics& physics, const std::vector<std::vector<std::string>>& sets,
                                      RayTracer& tracer);

}  // namespace fathom
