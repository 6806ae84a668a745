// A measurement directory as observations: what every placement's clouds say, over their trials.
#pragma once

#include <map>
#include <memory>

#include "diagnosis/measurement/desk_sights.h"
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

/// Reads rig.json, frames.csv and every cloud, on all threads: once for the desks, from which the unit's bias is
/// learned, and once more for what clouds say without it. Beside what named_values() lists: "valid_fraction" of the
/// pixels that look into the cup's opening. Placements whose frames hold heights only give "height_mm" of the whole
/// interior. In sessions with repeats desk_motion() as well. Places that were written down in another way are put right
/// (places.h); trials that are copies of others do not count (copies.h). Throws Error naming file and place. Tells of
/// its progress unless `quiet`.
Measurement read_measurement(const std::filesystem::path& folder, bool quiet = true);

/// The same in two steps, for several folders of one sensor. First what the clouds say with the unit's bias in them …
class Survey {
 public:
  Survey(const std::filesystem::path& folder, bool quiet);
  ~Survey();
  Survey(Survey&&) noexcept;

  const LaboratoryRig& rig() const;
  int sessions() const;  ///< the largest number and one
  Desks desks() const;
  /// … then what they say without. `unit` as learned from the desks of all folders.
  Measurement measure(std::shared_ptr<const UnitBias> unit) &&;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Nothing without desks.
std::shared_ptr<const UnitBias> learn_unit(const Desks& desks, bool is_calibrated);

}  // namespace fathom
