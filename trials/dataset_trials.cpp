#include "trials/dataset_trials.h"

#include <fmt/format.h>

#include <map>

#include "core/files.h"
#include "core/input_record.h"
#include "core/parallel.h"
#include "report/depth_picture.h"
#include "trials/failure_gallery.h"
#include "trials/trial_folder.h"
#include "trials/trial_picture.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

fs::path answers_to(const fs::path& folder, const DatasetFrames::SceneFolder& scene) {
  return folder / "scenes" / scene.name;
}

std::string frame_name(int image) { return fmt::format("{:06}", image); }

Image<float> depth_of(const Cloud& cloud) {
  Image<float> depth(cloud.width, cloud.height);
  for (std::size_t i = 0; i < depth.size(); ++i) depth.pixels()[i] = cloud.points[i].z();
  return depth;
}

/// The evaluation's identity for one scene. Its manifest stands for all of its files.
RunIdentity identity_of(const RunIdentity& evaluation, const DatasetFrames& frames,
                        const DatasetFrames::SceneFolder& scene) {
  RunIdentity identity = evaluation;
  const InputRecord inputs;
  record_input_file(frames.manifest_of(scene));
  identity.inputs.insert(inputs.files().begin(), inputs.files().end());
  return identity;
}

}  // namespace

void require_same_evaluation(const fs::path& folder, const DatasetFrames& frames,
                             const DatasetFrames::SceneFolder& scene, const RunIdentity& identity) {
  Manifest(answers_to(folder, scene), identity_of(identity, frames, scene)).require_same_run();
}

void search_scene(const fs::path& folder, const DatasetFrames& frames, const DatasetFrames::SceneFolder& scene,
                  const RunIdentity& identity, const Method& method, const DetectorSettings& settings,
                  const std::function<void()>& step) {
  TrialFolder answers(answers_to(folder, scene), identity_of(identity, frames, scene));
  std::vector<int> missing;
  for (int image = 0; image < scene.frames; ++image) {
    if (answers.kept(frame_name(image)))
      step();
    else
      missing.push_back(image);
  }
  parallel_items(static_cast<int>(missing.size()), [&](int i) {
    TrialResult result = search_trial(frames.read(scene, missing[i]), method, settings).result;
    result.detect_s = 0.0;
    result.stages_s.clear();
    answers.keep(frame_name(missing[i]), result);
    step();
  });
  answers.finish();
}

std::optional<std::vector<TrialResult>> searched(const fs::path& folder, const DatasetFrames& frames) {
  const auto file_of = [&](const DatasetFrames::SceneFolder& scene, int image) {
    return trial_file(answers_to(folder, scene), frame_name(image));
  };
  for (const DatasetFrames::SceneFolder& scene : frames.scenes())
    for (int image = 0; image < scene.frames; ++image)
      if (!fs::exists(file_of(scene, image))) return std::nullopt;
  std::vector<TrialResult> results;
  for (const DatasetFrames::SceneFolder& scene : frames.scenes())
    for (int image = 0; image < scene.frames; ++image) {
      const fs::path file = file_of(scene, image);
      const Json json = read_json(file);
      results.push_back(trial_from_json(JsonReader(json, file.string())));
      results.back().name = fmt::format("{}_{}", scene.name, frame_name(image));
    }
  return results;
}

std::vector<TrialResult> picture_failures(const fs::path& folder, const DatasetFrames& frames,
                                          const std::vector<TrialResult>& trials, const Method& method,
                                          const DetectorSettings& settings) {
  constexpr int kOfEachKind = 12;
  make_directory(folder / "failures");
  remove_leftovers(folder / "failures");
  std::map<std::string, int> shown;
  std::vector<TrialResult> pictured;
  auto trial = trials.begin();
  for (const DatasetFrames::SceneFolder& scene : frames.scenes())
    for (int image = 0; image < scene.frames; ++image, ++trial) {
      const std::string kind = failure_of(*trial);
      if (kind.empty() || ++shown[kind] > kOfEachKind) continue;
      const LabelledFrame frame = frames.read(scene, image);
      Image<Rgb> picture = depth_picture(depth_of(frame.cloud));
      draw_trial(frame, search_trial(frame, method, settings), 1, picture);
      write_png(folder / "failures" / fmt::format("{}_{}.png", trial->name, kind), picture);
      pictured.push_back(*trial);
    }
  return pictured;
}

}  // namespace fathom
