// frames.csv of a measurement directory: one line a shot, checked before the first cloud is read.
#pragma once

#include <optional>
#include <tuple>

#include "core/table.h"
#include "diagnosis/measurement/laboratory_rig.h"

namespace fathom {

struct FrameRecord {
  std::string frame;
  int session = 0, pour = 0, placement = 0, trial = 0;
  double time_s = 0.0;     ///< since the session began
  double stood_s = 0.0;    ///< since the first frame of its pour; 0 of a bare desk
  std::size_t folder = 0;  ///< of those that are read together
  std::string liquid;      ///< "empty", "none" (bare desk), or a liquid of the rig
  double fill_m = 0.0, distance_m = 0.0, lateral_m = 0.0;
  std::filesystem::path cloud;                            ///< empty: the height stands in the table
  std::filesystem::path infrared;                         ///< image beside the cloud; empty: none
  std::optional<double> height_mm, height_sd_mm, points;  ///< as far as the table has them

  bool bare_desk() const { return liquid == "none"; }
};

/// Frames that differ in their trial only.
using PlacementKey = std::tuple<int, int, int, std::string, double, double, double>;
PlacementKey placement_of(const FrameRecord& frame);

/// "distance 300 mm, lateral 0 mm"
std::string place_name(double distance_mm, double lateral_mm);
/// "20 mm of water", "empty"
std::string filling_name(const std::string& liquid, double fill_mm);

/// In the table's order; `cloud` may be missing as a column where there is `height_mm`. Throws Error naming line and
/// column: a missing column, an unknown liquid, what is no number,
/// a frame that a session has twice, time that runs backwards over a placement's trials, lengths that cannot be in mm
/// (a cup out of the sensor's sight, a fill or a height beyond the cup's), fills and places where there are none, a
/// cloud or an infrared image that is not there, and neither cloud nor height.
std::vector<FrameRecord> read_frames(const Table& frames, const LaboratoryRig& rig,
                                     const std::filesystem::path& folder);

}  // namespace fathom
