// The physical half of a diagnosis: the evidence of a measurement, and predictions for any effects.
#pragma once

#include <memory>

#include "diagnosis/predict/predictor.h"

namespace fathom {

struct Physics {
  Evidence evidence;
  Predict predict;                             ///< for the rows of the evidence; deterministic, on all threads
  std::shared_ptr<const Predictor> predictor;  ///< of these rows
  std::vector<std::string> unseen;             ///< effects of the registry that move no row
};

/// Rows: of the observations those that direct light predicts (predictable.h), without regions of the cup in or near
/// shadows. What is uncertain anyway (nuisances.h) and what the model leaves out (model_errors.h) are its nuisances,
/// the effects of the registry (candidates.h) its candidates, or where there are any `only` those. `model_effects` (as
/// in model.json) belong to the nominal model. Throws Error on what cannot be modelled. Tells of its progress unless
/// `quiet`.
Physics physics_of(const Measurement& measurement, const SharedJson& model_effects = SharedJson::array(),
                   const std::string& file = "rig.json", const std::vector<std::string>& only = {}, bool quiet = true);

}  // namespace fathom
