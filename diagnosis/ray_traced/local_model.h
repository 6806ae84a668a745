// A set of effects near some values, as a model says it that is dear to ask and not quite smooth.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Parameters are departures from nominal in prior scales, those of all effects one after the other.
struct LocalModel {
  std::vector<int> effects;  ///< candidates, ascending
  Eigen::VectorXd at;
  Eigen::VectorXd reach;   ///< half the width over which slopes were taken
  Eigen::VectorXd there;   ///< all observations, NaN where nothing is seen
  Eigen::MatrixXd slopes;  ///< observations × parameters

  Eigen::VectorXd operator()(const Eigen::VectorXd& parameters) const { return there + slopes * (parameters - at); }
};

/// With these parameters, taken at their bounds where they are beyond.
std::vector<EffectValue> effect_values(const Evidence& evidence, const std::vector<int>& effects,
                                       const Eigen::VectorXd& parameters);

/// The same, back.
Eigen::VectorXd parameters_of(const Evidence& evidence, const std::vector<int>& effects,
                              const std::vector<EffectValue>& values);

/// Slopes by central differences as wide as the departure itself, at least a prior scale, within the bounds: what a
/// matcher makes of dots jumps in small steps. Two questions for each parameter and one more.
LocalModel local_model(const Evidence& evidence, const std::vector<int>& effects, const Eigen::VectorXd& at,
                       const Predict& ask);

}  // namespace fathom
