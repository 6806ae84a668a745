// The diagnosis on desks that a Kinect measured: a part of the sensor's model is left out, and must be found and named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"

namespace fathom {

/// What the model of the sensor may be left without: effects by whose names they should be found again.
const std::vector<std::string>& known_of_desks();

struct DeskDiagnosis {
  Diagnosis diagnosis;
  double before = 0.0, after = 0.0;  ///< root mean square of measured minus model over the rows, in their errors
};

/// The nine measured desks (measured_desks.h) against a twin without that effect; empty: the whole model. Nothing when
/// the clouds are absent.
std::optional<DeskDiagnosis> diagnose_desks(const std::string& without);

}  // namespace fathom
