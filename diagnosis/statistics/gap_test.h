// Whether anything is left that the errors do not explain: four tests that see different shapes, joined into one p.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/null_calibration.h"
#include "diagnosis/statistics/scan.h"

namespace fathom {

/// Orthonormal directions with a share of each squared z in a sum.
struct WeightedDirections {
  Eigen::MatrixXd columns;
  Eigen::VectorXd weights, dof;  ///< degrees of freedom of the variance along each
};

/// Whitened columns that the tests project on.
struct GapShapes {
  std::vector<Stratum> strata;
  Eigen::MatrixXd stratum_columns;  ///< of all strata
  Eigen::VectorXd stratum_dof;      ///< of their variances
  Eigen::MatrixXd smooth_factor;    ///< not whitened
  Eigen::MatrixXd smooth;
  WeightedDirections main_effects, smooth_departures;
  Eigen::MatrixXd cells;  ///< orthonormal span of the cells' means; empty where hardly any cell is repeated
};

GapShapes gap_shapes(const Evidence& evidence, const Covariance& covariance);

/// Pseudo-experiments (n × draws, whitened) and their projections on all shapes, once for all tests.
struct GapDraws {
  Eigen::MatrixXd all;
  Eigen::MatrixXd strata, main_effects, smooth_departures, cells;  ///< columns of the shape × draws
};
GapDraws gap_draws(const GapShapes& shapes, Eigen::MatrixXd draws);

struct GapTest {
  double p = 1.0;                         ///< of the least of those below, calibrated on pseudo-experiments
  std::optional<double> p_lack_of_fit{};  ///< F of cell means against the scatter within cells
  double p_strata = 1.0;                  ///< χ² of all main effects
  double p_scan = 1.0;                    ///< largest single stratum
  double p_smooth = 1.0;  ///< of a Gaussian process: its likeliest shapes weigh one, those below the errors their share
  MaximumTail scan_tail;
};

/// All whitened; `explained` (orthonormal columns, may have none) is projected out of residual, draws and shapes.
GapTest gap_test(const GapShapes& shapes, const Eigen::VectorXd& residual, const GapDraws& draws,
                 const Eigen::MatrixXd& explained);

}  // namespace fathom
