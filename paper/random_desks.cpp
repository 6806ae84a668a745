#include "paper/random_desks.h"

#include <fmt/format.h>

#include "core/files.h"
#include "core/proportion.h"
#include "core/rng.h"
#include "trials/random_desk.h"

namespace fathom {

ClutterSpec changed_clutter(const std::string& file, const std::string& patch) {
  const std::filesystem::path path = data_directory() / "clutter" / file;
  Json json = read_json(path);
  json.merge_patch(Json::parse(patch));
  return clutter_spec_from_json(JsonReader(json, path.string()));
}

std::vector<std::vector<TrialResult>> search_desks(const ClutterSpec& clutter,
                                                   std::span<const std::string_view> methods, int desks,
                                                   std::uint64_t seed, Progress& progress) {
  DetectorSettings settings;
  settings.templates = templates_of(clutter);
  std::vector<std::vector<TrialResult>> results(methods.size());
  for (int desk = 0; desk < desks; ++desk) {
    const DeskShot shot = shoot_desk(random_scene(clutter, seed, desk), clutter.file, Rng(seed, desk).bits());
    for (std::size_t i = 0; i < methods.size(); ++i)
      results[i].push_back(search_trial(shot.labelled, method_named(methods[i]), settings).result);
    progress.step();
  }
  return results;
}

std::string share_text(int hits, int all) {
  if (all == 0) return "–";
  const Interval interval = wilson_95(hits, all);
  return fmt::format("{}/{} = {:.0f} % ({:.0f}–{:.0f} %)", hits, all, 100.0 * hits / all, 100.0 * interval.low,
                     100.0 * interval.high);
}

}  // namespace fathom
