// All explanations that the data leave open, with probabilities that sum to one.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fathom {

/// An explanation before it has words.
struct Option {
  std::vector<int> effects;
  Eigen::VectorXd parameters;  ///< departures from nominal in prior scales
  bool has_unknown = false;
  double log_posterior = 0.0;
  Eigen::VectorXd prediction;  ///< change against the nominal model, whitened; of the effects
};

struct AmbiguitySet {
  std::vector<std::vector<Option>> classes;  ///< most probable first; within one, options cannot be told apart
  std::vector<double> probabilities;
};

/// Options within `delta` of the best log posterior. Those whose predictions differ by less than one σ of all the data
/// together are one class: twins. A superset of an option (other than none) that is no better goes with the smaller
/// one.
AmbiguitySet ambiguity_set(std::vector<Option> options, double delta);

}  // namespace fathom
