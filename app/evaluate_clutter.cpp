// `fathom evaluate recognition` and `fathom evaluate liquid`: trials on random desks.
#include "app/evaluate.h"

#include <fmt/format.h>

#include "core/files.h"
#include "core/input_policy.h"
#include "core/progress.h"
#include "core/rng.h"
#include "sim/sensor/preview.h"
#include "trials/failure_gallery.h"
#include "trials/random_desk.h"
#include "trials/trial_picture.h"

namespace fathom {
namespace {

/// The scene with absolute names of its glTF cups, which lie beside `file`: it is written into another folder.
Json with_absolute_names(Json scene, const std::string& file) {
  for (Json& cup : scene["cups"])
    if (cup["shape"].is_string() && names_gltf(cup["shape"].get<std::string>()))
      cup["shape"] = std::filesystem::absolute(path_named_in(file, "/cups", cup["shape"].get<std::string>())).string();
  return scene;
}

/// The scene and the picture of a trial that failed.
void keep_failure(const std::filesystem::path& folder, const std::string& name, const Json& scene, const DeskShot& shot,
                  const Trial& trial) {
  const std::string why = failure_of(trial.result);
  if (why.empty()) return;
  Image<Rgb> picture = preview(shot.frame, shot.camera.truth());
  draw_trial(shot.labelled, trial, 2, picture);
  write_json(folder / fmt::format("{}_{}.json", name, why), with_absolute_names(scene, shot.setup.file));
  write_png(folder / fmt::format("{}_{}.png", name, why), picture);
}

std::string trial_name(std::size_t number) { return fmt::format("{:06}", number); }

}  // namespace

std::vector<TrialResult> run_trials(const ClutterEvaluation& evaluation, const CommonOptions& common,
                                    TrialFolder* folder) {
  const std::size_t conditions = evaluation.by_filling ? evaluation.clutter.fillings.size() : 1;
  std::vector<TrialResult> results;
  if (folder) {
    make_directory(common.output / "failures");
    remove_leftovers(common.output / "failures");
  }
  Progress progress("trial", conditions * evaluation.trials, common.quiet);
  for (std::size_t condition = 0; condition < conditions; ++condition) {
    ClutterSpec clutter = evaluation.clutter;
    if (evaluation.by_filling) clutter.fillings = {evaluation.clutter.fillings[condition]}, clutter.empty = 0.0;
    for (int i = 0; i < evaluation.trials; ++i) {
      // Each filling has numbers of its own: a run with more trials leaves those that are there as they were.
      constexpr std::size_t kMostTrials = 100000;
      const std::size_t number = condition * kMostTrials + i;
      const std::string name = trial_name(number);
      std::optional<TrialResult> result = folder ? folder->kept(name) : std::nullopt;
      if (!result) {
        const Json scene = random_scene(clutter, common.seed, number);
        const DeskShot shot = shoot_desk(scene, clutter.file, Rng(common.seed, number).bits());
        Trial trial = search_trial(shot.labelled, *evaluation.method, evaluation.detector);
        trial.result.shoot_s = shot.shoot_s;
        if (folder) {
          keep_failure(common.output / "failures", name, scene, shot, trial);
          folder->keep(name, trial.result);  // last: a trial that is noted is complete
        }
        result = std::move(trial.result);
      }
      result->name = name;
      results.push_back(*std::move(result));
      progress.step();
    }
  }
  if (folder) folder->finish();
  return results;
}

}  // namespace fathom
