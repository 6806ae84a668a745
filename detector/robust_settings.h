// The parameters of the robust method in the detector's configuration file.
#pragma once

#include "core/json.h"
#include "detector/robust_config.h"

namespace fathom {

/// Reads the object's keys over the defaults. Throws Error on anything unknown or out of range.
RobustConfig read_robust_config(const JsonReader& json);

}  // namespace fathom
