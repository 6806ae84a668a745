// A measurement directory as observations: what every placement's clouds say, over their trials.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "diagnosis/measurement/desk_cells.h"
#include "diagnosis/measurement/frames.h"
#include "diagnosis/measurement/unit_bias.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct Measurement {
  LaboratoryRig rig;
  std::vector<FrameRecord> frames;
  std::vector<Observation> observations;  ///< by session, pour, placement; then as named_values() has them
  std::vector<std::string> notes;         ///< what limits it, one sentence each: heights without clouds, …
  std::shared_ptr<const UnitBias> unit;   ///< that was taken off all clouds; empty where there are none
  DeskSights desk_sights;
  std::vector<Mistake> mistakes;  ///< "flipped_axis", "unit_error", "distance_to_front", "duplicated_trial": put right
};

/// What a frame was of; its times are those of its placement's trials, and are not filled in.
Factors factors_of(const FrameRecord& frame);

/// Reads rig.json, frames.csv and every cloud, on all threads: once for the desks, from which the unit's bias is
/// learned, and once more for what clouds say without it. Placements whose frames hold heights only give "height_mm" of
/// the whole interior. In sessions with repeats desk_motion() as well. Places that were written down in another way are
/// put right (places.h); trials that are copies of others do not count (copies.h). Throws Error naming file and place.
/// Tells of its progress unless `quiet`.
Measurement read_measurement(const std::filesystem::path& folder, bool quiet = true);

/// Reads all folders of one laboratory as one measurement: the unit's bias is learned from the desks of all, and the
/// sessions of each folder follow those of the one before. The rig is the first folder's, with the liquids of all.
/// Throws Error when another folder has another sensor, pose or cup, or another liquid by the same name, or repeats an
/// earlier one.
Measurement read_measurements(std::span<const std::filesystem::path> folders, bool quiet = true);

}  // namespace fathom
