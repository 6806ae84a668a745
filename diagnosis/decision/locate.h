// Where measured and predicted disagree.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/strata.h"

namespace fathom {

/// Strata whose means depart, one after the other, until none has p < `level`, all strata that were looked at counted
/// (Bonferroni). As long as one has, something departs; it is described by the stratum that departs most by its own p
/// < `level`. What that explains is taken out before the next is sought, so that a main effect does not return as ten
/// interactions. `dof` is that of the columns' variances. In the order of their shares of the gap, with the means that
/// all of them have together.
std::vector<GapLocation> locate(const std::vector<Stratum>& strata, const Eigen::MatrixXd& columns,
                                const Eigen::VectorXd& dof, const Eigen::VectorXd& residual, double level);

}  // namespace fathom
