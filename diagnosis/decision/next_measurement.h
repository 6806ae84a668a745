// Which further measurement would settle what this one leaves open.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// A measurement that could be made next.
struct Design {
  std::string name;   ///< "9 bare-desk views"
  double cost = 1.0;  ///< minutes
  /// As of a measurement that was made, in a session, pours and placements of its own; values and scatter of the
  /// repeats do not count. A nuisance of the same name is the same one. An effect that is no candidate moves nothing.
  Evidence evidence;
};

/// What could be measured next, with these effects as candidates.
using Designs = std::function<std::vector<Design>(const std::vector<std::string>& effects)>;

/// σ by which new observations would tell two explanations apart, beside what the old ones say already (Atkinson &
/// Fedorov's T-criterion 1975; of old and new together the squares add up): what is left of the difference when the
/// rival's parameters and all nuisances have done their best to hide it; the smaller one of either being true. Where
/// one has all effects of the other and more, that one is taken for true: with its further effects at 0 it is the
/// other. The new observations err as the old ones of their kind do.
double t_criterion(const Evidence& evidence, const Covariance& covariance, const Design& design, const Option& first,
                   const Option& second);

/// For each pair among the likeliest explanations the design with the largest T² per cost among those with T ≥ 3, else
/// the one with the largest T: below 3 it will not settle it, and neither will any other.
std::vector<NextMeasurement> next_measurements(const Evidence& evidence, const Covariance& covariance,
                                               const Designs& designs, const AmbiguitySet& set);

}  // namespace fathom
