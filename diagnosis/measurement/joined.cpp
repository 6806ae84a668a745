#include "diagnosis/measurement/joined.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace fathom {
namespace {

void require_same(const LaboratoryRig& rig, const std::filesystem::path& folder, const LaboratoryRig& first,
                  const std::filesystem::path& first_folder) {
  constexpr double kSame = 1e-7;  // [SI] rig.json is written to the nanometre
  const auto differs = [&](const std::string& path) {
    throw Error((folder / "rig.json").string(), path,
                fmt::format("must be as in {}: folders that are looked at together have one rig",
                            (first_folder / "rig.json").string()));
  };
  if (rig.sensor_model != first.sensor_model) differs("/sensor/model");
  if (!(rig.unit == first.unit)) differs("/sensor/unit");
  for (const RigValue& value : kRigValues)
    if (value.of_sensor && !(std::abs(rig.*value.of_sensor - first.*value.of_sensor) <= kSame))
      differs(fmt::format("/sensor/{}", value.key));
  if (!is_same_cup(rig.cup, first.cup)) differs("/cup");
  for (const auto& [name, medium] : rig.liquids)
    if (const auto known = first.liquids.find(name); known != first.liquids.end() && known->second != medium)
      differs("/liquids/" + name);
}

/// The sessions of `more`, the folder of that number, follow those of `all`.
void append(Measurement more, std::size_t folder, Measurement& all) {
  int sessions = 0;
  for (const FrameRecord& frame : all.frames) sessions = std::max(sessions, frame.session + 1);
  for (FrameRecord& frame : more.frames) {
    frame.session += sessions;
    frame.folder = folder;
    all.frames.push_back(std::move(frame));
  }
  for (Observation& observation : more.observations) {
    observation.factors.session += sessions;
    all.observations.push_back(std::move(observation));
  }
  all.desk_sights.add(more.desk_sights);
  all.rig.liquids.insert(more.rig.liquids.begin(), more.rig.liquids.end());
  for (std::string& note : more.notes) all.notes.push_back(std::move(note));
  for (Mistake& mistake : more.mistakes) all.mistakes.push_back(std::move(mistake));
}

}  // namespace

Measurement read_measurements(std::span<const std::filesystem::path> folders, bool quiet) {
  std::vector<Survey> surveys;
  Desks desks;
  int sessions = 0;
  for (const std::filesystem::path& folder : folders) {
    for (const std::filesystem::path& earlier : folders)
      if (&earlier < &folder && std::filesystem::equivalent(earlier, folder))
        throw Error(folder.string(), "is given twice, must be another measurement");
    surveys.emplace_back(folder, quiet);
    require_same(surveys.back().rig(), folder, surveys.front().rig(), folders.front());
    for (const auto& [scene, cells] : surveys.back().desks()) {
      DeskScene among_all = scene;
      among_all.session += sessions;
      desks[among_all] = cells;
    }
    sessions += surveys.back().sessions();
  }
  const std::shared_ptr<const UnitBias> unit = learn_unit(desks, surveys.front().rig().unit.map != nullptr);
  Measurement all = std::move(surveys.front()).measure(unit);
  for (std::size_t i = 1; i < surveys.size(); ++i) append(std::move(surveys[i]).measure(unit), i, all);
  return all;
}

}  // namespace fathom
