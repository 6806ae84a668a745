// Parts of the observations, by one factor or by two together: what may depart as a whole.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/statistics/covariance.h"
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

}  // namespace fathom
