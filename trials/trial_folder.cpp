#include "trials/trial_folder.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "core/input_policy.h"
#include "trials/failure_gallery.h"
#include "trials/trial_picture.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

std::string file_of_trial(const std::string& name) { return fmt::format("trials/{}.json", name); }

/// A scene for another folder than that of the file beside which its glTF cups lie.
Json with_absolute_names(Json scene, const std::string& file) {
  for (Json& cup : scene["cups"])
    if (cup["shape"].is_string() && names_gltf(cup["shape"].get<std::string>()))
      cup["shape"] = fs::absolute(path_named_in(file, "/cups", cup["shape"].get<std::string>())).string();
  return scene;
}

}  // namespace

TrialFolder::TrialFolder(const fs::path& folder, const RunIdentity& identity)
    : folder_(folder), owner_(folder), manifest_(folder, identity) {
  manifest_.require_same_run();
  if (!manifest_.exists() && fs::exists(folder_ / "trials"))
    throw Error((folder_ / "trials").string(), "is there already; choose another folder");
  manifest_.begin();
  for (const char* rates : {"rates.txt", "rates.json"}) fs::remove(folder_ / rates);  // they come last
  for (const char* name : {"trials", "failures"}) {
    make_directory(folder_ / name);
    remove_leftovers(folder_ / name);
  }
}

std::optional<TrialResult> TrialFolder::kept(const std::string& name) const {
  const std::string file = file_of_trial(name);
  if (!manifest_.holds(file)) return std::nullopt;
  const Json json = read_json(folder_ / file);
  return trial_from_json(JsonReader(json, (folder_ / file).string()));
}

void TrialFolder::keep(const std::string& name, const Json& scene, const TrialShot& shot, const Trial& trial) {
  if (const std::string why = failure_of(trial.result); !why.empty()) {
    write_json(folder_ / "failures" / fmt::format("{}_{}.json", name, why),
               with_absolute_names(scene, shot.setup.file));
    write_png(folder_ / "failures" / fmt::format("{}_{}.png", name, why), trial_picture(shot, trial));
  }
  write_json(folder_ / file_of_trial(name), json_of(trial.result));
  manifest_.add(file_of_trial(name));  // last: a trial that is noted is complete
}

}  // namespace fathom
