// How large the heights' differences are, before and after, in all and by stratum, fitted and held out.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {

/// The observable whose differences are a gap's size: heights in cups; where there are none, the sensor's above the
/// desk.
std::string compared_height(const std::vector<Observation>& observations);

/// Of some observations' differences before and after, and of their errors' variance.
GapSize gap_size(const Eigen::VectorXd& before, const Eigen::VectorXd& after, const Eigen::VectorXd& variance,
                 const std::vector<Eigen::Index>& rows);

/// Before: as predicted. After: with the effects, and with nuisances as the (other) data want them within their priors.
void measure_gaps(const Case& c, const Refit& fit, Diagnosis& diagnosis);

}  // namespace fathom
