// `fathom evaluate DIR` of a data set: the detector's report card.
#include "app/evaluate.h"

#include "app/print.h"
#include "app/results.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/input_record.h"
#include "core/progress.h"
#include "core/rows.h"
#include "detector/settings_json.h"
#include "report/gnuplot.h"
#include "trials/dataset_trials.h"
#include "trials/rates.h"
#include "trials/report_card.h"
#include "trials/trial_tables.h"

namespace fathom {

bool is_dataset(const std::filesystem::path& folder) { return std::filesystem::exists(folder / "dataset.json"); }

void evaluate_dataset(const DatasetEvaluation& evaluation, const CommonOptions& common) {
  require_output(common);
  require_gnuplot();
  const Method& method = *evaluation.method;
  RunIdentity identity{"evaluate data set", {{"method", method.name}}};
  DetectorSettings settings;
  {
    const InputRecord inputs;
    settings = read_detector_settings(evaluation.config);
    identity.inputs = inputs.files();
  }
  const DatasetFrames frames(evaluation.data_set);
  std::vector<DatasetFrames::SceneFolder> mine;
  std::size_t count = 0;
  for (std::size_t i = evaluation.shard.number; i < frames.scenes().size(); i += evaluation.shard.count) {
    mine.push_back(frames.scenes()[i]);
    count += mine.back().frames;
  }
  {
    const FolderOwner owner(common.output, kShardPatience);
    // Also the other shards' scenes: a card is of one evaluation.
    for (const DatasetFrames::SceneFolder& scene : frames.scenes())
      require_same_evaluation(common.output, frames, scene, identity);
    remove_results(common, "rates", ".txt");  // they come last
    make_directory(common.output / "scenes");
  }
  Progress progress("frame", count, common.quiet);
  for (const DatasetFrames::SceneFolder& scene : mine)
    search_scene(common.output, frames, scene, identity, method, settings, [&] { progress.step(); });
  const FolderOwner owner(common.output, kShardPatience);
  const std::optional<std::vector<TrialResult>> trials = searched(common.output, frames);
  if (!trials) {
    print_text(format_rows({{"frames", static_cast<double>(count)}, {"complete", "no"}}, common.json));
    return;
  }
  const std::vector<Row> rates = detection_rates(method.name, *trials);
  write_table(common.output / "cups.csv", cups_table(*trials));
  write_reliability(common.output, *trials);
  write_report_card(common.output, *trials, rates, picture_failures(common.output, frames, *trials, method, settings));
  const std::string text = format_rows(rates, common.json);
  print_text(text);
  write_results(common, "rates", ".txt", text);
}

}  // namespace fathom
