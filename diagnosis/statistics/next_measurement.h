// Which further measurement would settle what this one leaves open.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/diagnosis.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// A measurement that could be made, as the model sees it: observations that are not there yet.
struct Design {
  std::string name;                         ///< "9 bare-desk views"
  double cost = 1.0;                        ///< in any unit, the same for all: minutes
  Eigen::VectorXd error_sd;                 ///< of each new observation, beyond nuisances
  std::vector<Eigen::MatrixXd> signatures;  ///< of each candidate: new observations × its parameters, per unit
  Eigen::MatrixXd nuisances;                ///< new observations × the evidence's nuisances, per unit
  /// Nuisances that only the new observations have: a new pour's fill. Scaled by their prior σ; may have no columns.
  Eigen::MatrixXd own_nuisances;
};

/// σ by which old and new observations together would tell two explanations apart (Atkinson & Fedorov's T-criterion
/// 1975): what is left of the difference when the rival's parameters and all nuisances have done their best to hide it;
/// the smaller one of either being true.
double t_criterion(const Evidence& evidence, const Covariance& covariance, const Design& design, const Option& first,
                   const Option& second);

/// For each pair among the likeliest explanations the design with the largest T² per cost among those with T ≥ 3, else
/// the one with the largest T: below 3 it will not settle it, and neither will any other.
std::vector<NextMeasurement> next_measurements(const Evidence& evidence, const Covariance& covariance,
                                               const std::vector<Design>& designs, const AmbiguitySet& set);

}  // namespace fathom
