// How well cups were found over many trials, and how well their contents were judged.
#pragma once

#include <string_view>
#include <vector>

#include "core/rows.h"
#include "trials/trial.h"

namespace fathom {

/// Recognition with its intervals, misses by kind, false cups, liquid_rates(), and medians of the times that were kept.
std::vector<Row> detection_rates(std::string_view method, const std::vector<TrialResult>& trials);

}  // namespace fathom
