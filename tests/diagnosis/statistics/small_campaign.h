// A campaign of 240 observations, on which a decision takes a fraction of a second.
#pragma once

#include "core/rng.h"
#include "diagnosis/statistics/groups.h"
#include "tests/diagnosis/statistics/synthetic_campaign.h"

namespace fathom {

inline CampaignDesign small_design() {
  CampaignDesign design;
  design.laterals_mm = {0, 100};
  design.fills_mm = {10, 40};
  design.distances_mm = {200, 400};
  return design;
}

/// Every filling is poured once and put down three times at each place.
inline CampaignDesign once_poured_design() {
  CampaignDesign design;
  design.laterals_mm = {0};
  design.fills_mm = {10, 16, 22, 28, 34, 40, 46, 52};
  design.regions = {"centre"};
  design.has_infrared = design.has_desk = false;
  design.pours = design.sessions = 1;
  design.placements = 3;
  return design;
}

/// Heights of each pour are off together, by more than anybody stated.
inline Evidence with_errors_of_pours(Evidence evidence, double sd, std::uint64_t seed) {
  for (Observation& o : evidence.observations)
    if (!pour_key(o).empty()) o.value += sd * Rng(seed, o.factors.pour).normal();
  return evidence;
}

inline Eigen::VectorXd residual_of(const Evidence& evidence) {
  Eigen::VectorXd residual = -evidence.predicted;
  for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] += evidence.observations[i].value;
  return residual;
}

}  // namespace fathom
