// How well the contents of cups were judged over many trials: decisions, probabilities, levels and kinds.
#pragma once

#include <filesystem>
#include <vector>

#include "core/rows.h"
#include "core/table.h"
#include "trials/trial.h"

namespace fathom {

/// Of recognised cups. Where the method is sure: `sensitivity`, also for each depth of a design, and `specificity`;
/// `kind_right`. `p_liquid_calibration_error`: the expected calibration error over the classes of reliability_table().
/// Mean absolute errors of the levels by what truly fills the cup, and `fill_within_95`: how many lie within 1.96 of
/// their own σ. Shares come with Wilson's 95 % interval; what no cup says anything about has no row.
std::vector<Row> liquid_rates(const std::vector<TrialResult>& trials);

/// Ten classes of P(liquid), those that hold cups: how many, their mean P, the share that is filled and its interval.
Table reliability_table(const std::vector<TrialResult>& trials);

/// reliability.csv, .png, .svg and .gp in the folder, unless the method gives no probabilities.
void write_reliability(const std::filesystem::path& folder, const std::vector<TrialResult>& trials);

}  // namespace fathom
