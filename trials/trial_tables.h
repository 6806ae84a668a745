// What came of many trials, as tables.
#pragma once

#include <vector>

#include "core/table.h"
#include "trials/trial.h"

namespace fathom {

/// A row for each cup that stands there, and for each that does not.
Table cups_table(const std::vector<TrialResult>& trials);

/// A row for each filling: recognised and detected, as the paper's Table I.
Table fillings_table(const std::vector<TrialResult>& trials);

}  // namespace fathom
