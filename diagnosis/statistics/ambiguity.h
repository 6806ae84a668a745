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

/// Explanations that cannot be told apart.
struct AmbiguityClass {
  std::vector<Option> options;  ///< likeliest first
  double probability = 0.0;
  bool adds_to_likelier = false;  ///< hold all effects of a likelier class, and more that the data need not have
};

struct AmbiguitySet {
  std::vector<AmbiguityClass> classes;  ///< likeliest first; those that add to a class after all others
};

/// Options within `delta` of the best log posterior. Those whose predictions differ by less than one σ of all the data
/// together are one class: twins. Supersets of an option (other than none) that are no better go with it; those that
/// are plausible nevertheless are together a class of their own.
AmbiguitySet ambiguity_set(std::vector<Option> options, double delta);

}  // namespace fathom
