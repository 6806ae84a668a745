// A campaign of 240 observations, on which a decision takes a fraction of a second.
#pragma once

#include "tests/diagnosis/statistics/synthetic_campaign.h"

namespace fathom {

inline CampaignDesign small_design() {
  CampaignDesign design;
  design.laterals_mm = {0, 100};
  design.fills_mm = {10, 40};
  design.distances_mm = {200, 400};
  return design;
}

inline Eigen::VectorXd residual_of(const Evidence& evidence) {
  Eigen::VectorXd residual = -evidence.predicted;
  for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] += evidence.observations[i].value;
  return residual;
}

}  // namespace fathom
