// Detection rates over random desks: the paper's two experiments, and as many trials as one likes.
#pragma once

#include <vector>

#include "app/command.h"
#include "core/rows.h"
#include "core/table.h"
#include "sim/scene/clutter.h"
#include "trials/clutter_trial.h"
#include "trials/trial_folder.h"

namespace fathom {

struct ClutterEvaluation {
  ClutterSpec clutter;
  Json config;              ///< text of the method's configuration file; null without one
  bool by_filling = false;  ///< as many trials of each of the spec's fillings; else each cup draws one
  int trials = 20;
  const Method* method = nullptr;
  DetectorSettings detector;
};

/// The trials in their order; with a `folder` each is kept there, and those that it holds already are not shot again.
std::vector<TrialResult> run_trials(const ClutterEvaluation& evaluation, const CommonOptions& common,
                                    TrialFolder* folder);

/// Recognition, and where cups are filled sensitivity and specificity, with their intervals; misses by kind.
std::vector<Row> rates(const ClutterEvaluation& evaluation, const std::vector<TrialResult>& trials);

/// A row for each cup that stands there, and for each that does not.
Table cups_table(const std::vector<TrialResult>& trials);

/// A row for each filling: recognised and detected, as the paper's Table I.
Table fillings_table(const std::vector<TrialResult>& trials);

}  // namespace fathom
