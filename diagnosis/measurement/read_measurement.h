// A measurement directory as observations: what every placement's clouds say, over their trials.
#pragma once

#include "diagnosis/measurement/frames.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct Measurement {
  LaboratoryRig rig;
  std::vector<FrameRecord> frames;
  std::vector<Observation> observations;  ///< by session, pour, placement; then as named_values() has them
  std::vector<std::string> notes;         ///< what limits it, one sentence each: heights without clouds, …
  std::vector<Mistake> mistakes;  ///< "flipped_axis", "unit_error", "distance_to_front", "duplicated_trial": put right
};

/// Reads rig.json, frames.csv and every cloud once, on all threads. Beside what named_values() lists: "valid_fraction"
/// of the pixels that look into the cup's opening, "ir_contrast" (deviation over mean of the brightness, where a cloud
/// has it) inside and on the desk. Placements whose frames hold heights only give "height_mm" of the whole interior.
/// In sessions with repeats desk_motion() as well.
/// Places that were written down in another way are put right (places.h); trials that are copies of others do not
/// count (copies.h). Throws Error naming file and place. Tells of its progress unless `quiet`.
Measurement read_measurement(const std::filesystem::path& folder, bool quiet = true);

}  // namespace fathom
