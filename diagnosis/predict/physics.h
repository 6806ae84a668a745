// The physical half of a diagnosis: the evidence of a measurement, and predictions for any effects.
#pragma once

#include "diagnosis/predict/predictor.h"

namespace fathom {

struct Physics {
  Evidence evidence;
  Predict predict;                  ///< for the rows of the evidence; deterministic, on all threads
  std::vector<std::string> unseen;  ///< effects of the registry that move no row
};

/// Rows: of the observations those that direct light predicts, which are heights by region, the desk's plane and its
/// residuals, and one comb of each kind in a session. Left out: regions of the cup in or near shadows, spreads, valid
/// fractions, brightness and contrast, which walls, scattering and matching decide. Nuisances: what the surrogate
/// leaves out (by observable, region and liquid), the fill of every pour, the place of every placement, and the rig's
/// uncertain values, 1 σ from the rig or else height 0.5 mm, pitch and roll 0.05°, baseline 0.05 mm, focal length 0.4
/// px, disparity offset 0.02 px, the cup's bottom 0.1 mm. Candidates: every effect of the registry; those of liquids
/// also for each liquid apart, as "id@liquid", where there are several. Signatures are central differences over the
/// prior scale, one-sided at a bound, with the same rays on both sides. `model_effects` (as in model.json) belong to
/// the nominal model. Throws Error on what cannot be modelled.
Physics physics_of(const Measurement& measurement, const Json& model_effects = Json::array(),
                   const std::string& file = "rig.json");

}  // namespace fathom
