// The effects that a campaign could show, with what each does to the observations.
#pragma once

#include "diagnosis/predict/predictor.h"

namespace fathom {

struct Candidates {
  std::vector<Candidate> all;       ///< without `only` those too that move no observation, with sensitivities of 0
  std::vector<std::string> unseen;  ///< effects that move no observation
};

/// Change per unit of all observations between `at(low)` and `at(high)`.
using Slope = std::function<Eigen::VectorXd(const std::function<EffectValue(double)>& at, double low, double high)>;

/// The effect by that name (EffectName). Its sensitivity: differences from one prior scale below nominal to one above,
/// no farther than the bounds.
Candidate candidate_by_slopes(const Effect& effect, const std::string& name, const Slope& slope);

/// Every effect of the registry but mistakes in writing down, which bookkeeping.h finds; those of liquids also for each
/// liquid apart, as "id@liquid", where they show in several. With `only` those named, as far as they move anything.
/// Throws Error on an unknown name. Tells of its progress unless `quiet`.
Candidates candidates_of(const Predictor& predictor, const std::vector<std::string>& only = {}, bool quiet = true);

}  // namespace fathom
