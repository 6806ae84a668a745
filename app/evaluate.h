// The parts of `fathom evaluate`: detection rates over random desks, and the detector's report card of a data set.
#pragma once

#include <filesystem>
#include <vector>

#include "app/command.h"
#include "core/json.h"
#include "datasets/generate.h"
#include "sim/scene/clutter.h"
#include "trials/trial.h"
#include "trials/trial_folder.h"

namespace fathom {

/// The paper's two experiments on random desks, and as many trials as one likes.
struct ClutterEvaluation {
  ClutterSpec clutter;
  Json config;              ///< text of the method's configuration file; null without one
  bool by_filling = false;  ///< `trials` of each of the spec's fillings; else each cup draws one
  int trials = 20;
  const Method* method = nullptr;
  DetectorSettings detector;
};

/// The trials in their order; with a `folder` each is kept there, and those that it holds already are not shot again.
std::vector<TrialResult> run_trials(const ClutterEvaluation& evaluation, const CommonOptions& common,
                                    TrialFolder* folder);

struct DatasetEvaluation {
  std::filesystem::path data_set;
  std::filesystem::path config;  ///< the detector's, if any
  const Method* method;
  Shard shard;
};

/// Whether the folder is one that `fathom generate` has made.
bool is_dataset(const std::filesystem::path& folder);

/// Searches this process's part of the frames; when all parts are there, writes the report card. Throws UsageError
/// without -o.
void evaluate_dataset(const DatasetEvaluation& evaluation, const CommonOptions& common);

}  // namespace fathom
