// Whether an effect holds in condition groups that had no part in finding its size.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/linear_fit.h"

namespace fathom {

struct Confirmation {
  double p = 1.0;          ///< one-sided: the effect has the same sign and shape where it was not fitted
  int folds_improved = 0;  ///< informative folds in which the others' fit lowers the residual
  int folds_informative = 0;
  double p_sign_flip = 1.0;  ///< effect's sum over pours against random signs of each (Fisher's randomisation)
};

/// For each effect. Thirds of the condition groups take turns: on two the effects are fitted (discovery), on the third
/// each effect is tested along the fitted shape with the others free (confirmation), and the three z are put together
/// by their information. `draws`: pseudo-experiments, not whitened, that say how wide this sum is when nothing is
/// there; `dof` of each effect's variance.
std::vector<Confirmation> confirm(const std::vector<Observation>& observations, const Covariance& covariance,
                                  const LinearFit& fit, const Eigen::MatrixXd& draws, const std::vector<double>& dof,
                                  std::uint64_t seed);

/// Fits of the parameters without some rows, with everything needed to predict these: for gaps on held-out groups.
struct HeldOut {
  Eigen::VectorXd residual;  ///< of every observation, by the fit of effects and nuisances to the other folds
  Eigen::VectorXd variance;  ///< that it should have
};
HeldOut held_out(const Covariance& covariance, const LinearFit& fit, const std::vector<int>& folds);

}  // namespace fathom
