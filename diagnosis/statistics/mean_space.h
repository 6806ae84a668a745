// Which contrasts of the observations are free of any effect, so that error alone is in them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct MeanSpace {
  Eigen::MatrixXd contrasts;    ///< rows × m, orthonormal, orthogonal to all means
  bool from_replicates = true;  ///< means are those of cells; else a smooth function's
};

/// Orthonormal contrasts of the rows of `weights` (sums of observations) that no candidate's sensitivity changes, nor a
/// constant.
Eigen::MatrixXd free_of_candidates(const Evidence& evidence, const Eigen::MatrixXd& weights);

/// For the rows of one observable. Where at least eight contrasts lie within cells (equal conditions, observable and
/// region), those that no drift over the sessions changes. Otherwise the mean may be
/// anything that the candidates' sensitivities and second-degree polynomials in fill, distance and lateral, for each
/// liquid and region, make: as many of them as leave half of the rows.
MeanSpace mean_space(const Evidence& evidence, const std::vector<Eigen::Index>& rows);

/// Means over the cells of one observable's rows, and which contrasts of them no smooth function as above makes.
struct CellMeans {
  Eigen::MatrixXd over;       ///< cells × rows
  Eigen::MatrixXd contrasts;  ///< cells × m
};
CellMeans cell_means(const Evidence& evidence, const std::vector<Eigen::Index>& rows);

}  // namespace fathom
