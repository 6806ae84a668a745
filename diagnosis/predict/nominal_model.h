// What the laboratory believes, as set-ups that can be simulated.
#pragma once

#include <map>

#include "diagnosis/measurement/laboratory_rig.h"
#include "diagnosis/statistics/evidence.h"
#include "sim/scene/setup.h"

namespace fathom {

/// The parts of all set-ups of a campaign, read once.
struct NominalModel {
  LaboratoryRig laboratory;
  Rig rig;
  CupShape cup;
  std::map<std::string, Medium> liquids;
};

/// The sensor's model with the rig's numbers, and the cup. Throws Error, as coming from `file`, on unknown names and
/// media.
NominalModel nominal_model(const LaboratoryRig& laboratory, const std::string& file);

/// The set-up in which a frame with these factors is shot, without effects. A bare desk has no cup.
Setup setup_of(const NominalModel& model, const Factors& factors);

}  // namespace fathom
