// All explanations that the data leave open, with probabilities that sum to one.
#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

namespace fathom {

/// An explanation before it has words.
struct Option {
  std::vector<int> effects;
  Eigen::VectorXd parameters;  ///< departures from nominal in prior scales
  bool has_unknown = false;
  double log_posterior = 0.0;
  Eigen::VectorXd prediction;  ///< change against the nominal model, whitened; of the effects

  bool is_nothing() const { return effects.empty() && !has_unknown; }
  bool is_unknown_alone() const { return effects.empty() && has_unknown; }
  bool is_too_small() const;  ///< for all the data together to show
};

/// The first of the highest log posterior; there must be one.
const Option& likeliest(const std::vector<Option>& options);

/// Explanations that cannot be told apart, or that name the same effects in other liquids.
struct AmbiguityClass {
  std::vector<Option> options;         ///< likeliest first
  std::vector<Option> supersets = {};  ///< all effects of one of the options, and more that the data need not have
  double probability = 0.0;            ///< of all of them together
  double alone = 0.0;                  ///< of the options
};

/// Whether all options have the same effects, in whichever liquids.
bool is_one_explanation(const AmbiguityClass& one, const std::vector<int>& kinds);

/// The first option's share of the options' probability.
double share_of_first(const AmbiguityClass& one);

struct AmbiguitySet {
  std::vector<AmbiguityClass> classes;  ///< likeliest first

  /// Where tests say that something unknown is there.
  void put_unknown_first();
};

/// Of an option's effects, whatever liquids they are of. `kinds`: of each candidate, a number that it shares with the
/// same effect in other liquids.
std::set<int> kinds_of(const Option& option, const std::vector<int>& kinds);

/// Options within `delta` of the best log posterior; probabilities are shared among them. Those whose predictions
/// differ by less than one σ of all the data together are aliased, of one class. A superset of a non-empty option joins
/// its class unless it is likelier; one with something unknown must be likelier by `doubt_of_unknown`, a log of odds.
AmbiguitySet ambiguity_set(std::vector<Option> options, const std::vector<int>& kinds, double delta,
                           double doubt_of_unknown = 0.0);

}  // namespace fathom
