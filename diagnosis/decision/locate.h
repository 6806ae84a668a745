// Where measured and predicted disagree.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/strata.h"

namespace fathom {

/// A stratum in which an explanation shows, and the p that errors alone show it so, of all that were looked at.
struct ExplainedStratum {
  Eigen::Index number;
  double p;
};

/// The liquids in which measured and predicted heights differ as an explanation has it, by what was measured in each
/// alone: those with p < `level`. `explained`: n, whitened, what the explanation adds to the prediction.
std::vector<ExplainedStratum> liquids_with(const Case& c, const Eigen::VectorXd& explained, double level);

/// Strata whose means depart, one after the other, until none has p < `level`, all strata that were looked at counted
/// (Bonferroni). As long as one has, something departs; it is described by the stratum that departs most by its own p
/// < `level`. What that explains is taken out before the next is sought, so that a main effect does not return as ten
/// interactions. Strata of `explained` that none of these is part of, or has as a part, come last.
///   `dof` is that of the columns' variances. In the order of their shares of the gap, with the means that all of them
/// have together.
std::vector<GapLocation> locate(const std::vector<Stratum>& strata, const Eigen::MatrixXd& columns,
                                const Eigen::VectorXd& dof, const Eigen::VectorXd& residual, double level,
                                const std::vector<ExplainedStratum>& explained = {});

}  // namespace fathom
