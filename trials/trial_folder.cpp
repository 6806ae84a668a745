#include "trials/trial_folder.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

std::string file_of_trial(const std::string& name) { return fmt::format("trials/{}.json", name); }

}  // namespace

fs::path trial_file(const fs::path& folder, const std::string& name) { return folder / file_of_trial(name); }

TrialFolder::TrialFolder(const fs::path& folder, const RunIdentity& identity)
    : folder_(folder), owner_(folder), manifest_(folder, identity) {
  manifest_.require_same_run(std::vector<std::string>{"trials"});
  manifest_.begin();
  for (const char* rates : {"rates.txt", "rates.json"}) fs::remove(folder_ / rates);  // they come last
  make_directory(folder_ / "trials");
  remove_leftovers(folder_ / "trials");
}

std::optional<TrialResult> TrialFolder::kept(const std::string& name) const {
  const std::string file = file_of_trial(name);
  if (!manifest_.holds(file)) return std::nullopt;
  const Json json = read_json(folder_ / file);
  return trial_from_json(JsonReader(json, (folder_ / file).string()));
}

void TrialFolder::keep(const std::string& name, const TrialResult& result) {
  write_json(folder_ / file_of_trial(name), json_of(result));
  manifest_.add(file_of_trial(name));
}

}  // namespace fathom
