// Detection rates over random desks: the paper's two experiments, and as many trials as one likes.
#pragma once

#include <vector>

#include "app/command.h"
#include "sim/scene/clutter.h"
#include "trials/trial.h"
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

}  // namespace fathom
