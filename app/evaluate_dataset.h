// `fathom evaluate DIR` of a data set: the detector's report card.
#pragma once

#include <filesystem>
#include <string>

#include "app/command.h"
#include "app/options.h"
#include "detector/detector.h"

namespace fathom {

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
