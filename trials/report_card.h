// A detector's report card: its rates over many labelled frames, class by class of what makes them hard.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/proportion.h"
#include "core/rows.h"
#include "core/table.h"
#include "trials/trial.h"

namespace fathom {

/// A share of the cups, or of the frames, of one class.
struct CardRow {
  std::string factor;  ///< what the classes differ in: "distance from the camera [mm]"
  std::string group;   ///< "500 to 600"
  std::string rate;    ///< "recognised", "liquid told", "liquid right", "false cup"
  int hits, of;

  double share() const { return static_cast<double>(hits) / of; }
  Interval interval() const { return wilson_95(hits, of); }
};

/// Of cups: `recognised`; of these `liquid told`, where the method says yes or no; of these `liquid right`. Of frames:
/// `false cup`. By the sensor, the distance, the share in sight, the other things in the frame, what the cup
/// holds, how deep, and the kind of cup. Classes that nothing is in have no row.
std::vector<CardRow> report_card(const std::vector<TrialResult>& trials);

/// With Wilson's 95 % interval.
Table card_table(const std::vector<CardRow>& card);

/// Writes card.csv, card.png and card.svg into the folder, and index.html, which shows them, `rates`, and the pictures
/// that stand in failures/ of some of the trials that failed.
void write_report_card(const std::filesystem::path& folder, const std::vector<TrialResult>& trials,
                       const std::vector<Row>& rates, const std::vector<TrialResult>& pictured);

}  // namespace fathom
