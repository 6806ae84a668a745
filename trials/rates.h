// How well cups were found over many trials, and how well their contents were judged: decisions, probabilities, levels
// and kinds.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/rows.h"
#include "core/table.h"
#include "trials/trial.h"

namespace fathom {

/// A share of trials as rows: NAME "hits/trials", NAME_low and NAME_high, Wilson's 95 % interval.
void add_share(const std::string& name, int hits, int trials, std::vector<Row>& rows);

/// Recognition, misses by kind, false cups and medians of the times that were kept. Of the recognised cups, where the
/// method is sure: `sensitivity`, also for each depth of a design, and `specificity`; `kind_right`.
/// `p_liquid_calibration_error`: the expected calibration error over the classes of reliability_table(). Mean absolute
/// errors of the levels by what truly fills the cup, and `fill_within_95`: how many lie within 1.96 of their own σ.
/// Shares come with Wilson's 95 % interval; of the contents, what no cup says anything about has no row.
std::vector<Row> detection_rates(std::string_view method, const std::vector<TrialResult>& trials);

/// Ten classes of P(liquid), those that hold cups: how many, their mean P, the share that is filled and its interval.
Table reliability_table(const std::vector<TrialResult>& trials);

/// reliability.csv, .png, .svg and .gp in the folder, unless the method gives no probabilities.
void write_reliability(const std::filesystem::path& folder, const std::vector<TrialResult>& trials);

}  // namespace fathom
