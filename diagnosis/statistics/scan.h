// Where measured and predicted disagree: parts of the observations, by one factor or by two together.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/diagnosis.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct Stratum {
  std::string observable;
  std::string name;     ///< "all", "liquid=milk_tea", "liquid=milk_tea, distance_mm=400"
  bool is_main = true;  ///< by one factor at most
  std::vector<Eigen::Index> rows;
};

/// For each observable: all of it, each level of each factor, each pair of levels of two factors that at least three
/// observations share. Parts with the same rows are listed once.
std::vector<Stratum> list_strata(const std::vector<Observation>& observations);

/// Whitened indicators, n × strata: |column|⁻¹ is the standard error of a stratum's mean by generalised least squares.
Eigen::MatrixXd stratum_columns(const std::vector<Stratum>& strata, const Covariance& covariance);

/// Strata with a significant mean, one after the other: the most significant is taken out before the next is sought
/// (so a main effect does not return as ten interactions), until none has p < `level`, all strata that were looked at
/// counted (Bonferroni). `dof` is that of the columns' variances. In the order of their shares of the gap, with the
/// means that all of them have together.
std::vector<GapLocation> locate(const std::vector<Stratum>& strata, const Eigen::MatrixXd& columns,
                                const Eigen::VectorXd& dof, const Eigen::VectorXd& residual, double level);

}  // namespace fathom
