// What a measurement directory holds and what it lacks, before anybody waits for a diagnosis: all of its table, few of
// its clouds. Words for it are the program's.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/measurement/frames.h"

namespace fathom {

/// What a diagnosis would be without, or what is other than the notes say; the dearest first.
enum class Lack {
  conditions,     ///< `size` of them are too few for any answer but `insufficient`
  desk_height,    ///< of clouds that were looked at the camera stands so many mm higher above the desk than in rig.json
  desk_pitch,     ///< … looks so many degrees steeper
  desk_roll,      ///< … is turned by so many degrees more
  desk_in_sight,  ///< clouds that were looked at show no desk at all: `names` of frames
  cup_in_sight,   ///< they show the bare desk where the cup should stand: `names` of frames
  cup_in_image,   ///< parts of cups lie outside the image, at worst a share of `size` is in it: `names` of places
  inside_in_sight,  ///< of the cup's inside too few pixels are seen: `size` at worst, `names` of conditions
  whole_clouds,     ///< files much smaller than the others: `names` of frames
  clouds,           ///< `size` frames have a height and no cloud
  bare_desk_views,  ///< there are none; a unit's own bias, or what calibration left of it, is about `size` mm at cups
  repeats,          ///< too little was measured twice
  trials,           ///< each placement has one shot
  placements,       ///< no cup was put down twice at one place with one filling
  pours,            ///< `names` of fillings that were poured once
  empty_cup,        ///< nobody looked at the cup's bottom
  fills,            ///< `names` of liquids at one depth
  distances,        ///< all cups stand at one distance
  laterals,         ///< … at one lateral
  sessions,         ///< there is one session
  times,            ///< all frames have the same time
  brightness,       ///< clouds without the infrared's intensity
  stated_sigmas     ///< `names` of values in rig.json whose 1 σ is the default
};

struct Shortfall {
  Lack lack;
  double size = 0.0;
  std::vector<std::string> names{};
};

struct MeasurementCheck {
  LaboratoryRig rig;
  std::size_t frames = 0, clouds = 0, heights = 0;  ///< with a cloud; with a height and none
  std::size_t bare_desk_views = 0, pours = 0, placements = 0;
  std::size_t fewest_trials = 0, most_trials = 0;  ///< of placements
  std::size_t sessions = 0;
  bool session_mm_stated = false, session_deg_stated = false;  ///< in rig.json; else their defaults hold
  std::map<std::string, std::set<double>> fills_mm;            ///< by liquid; of "empty" 0
  std::set<double> distances_mm, laterals_mm;
  std::size_t clouds_read = 0;
  int width = 0, height = 0;  ///< of the first cloud; 0 without one, height 1 of one without rows
  std::vector<Shortfall> lacks;
};

/// Reads rig.json, frames.csv and some of the clouds, at most eight, evenly over the frames. Throws Error where a
/// diagnosis would: what read_rig() and read_frames() refuse, clouds that are missing (all are counted), empty or
/// unreadable, and where most of those that are read show no desk, or no cup.
MeasurementCheck check_measurement(const std::filesystem::path& folder);

}  // namespace fathom
