// A laboratory's sensor and cup, as it believes them: rig.json of a measurement directory.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/json.h"

namespace fathom {

/// Of the images that a rig's focal length is for.
inline constexpr double kImageWidth_px = 640.0, kImageHeight_px = 480.0;

/// Lengths in metres, angles in radians. What the file does not give keeps its default: the sensor model's optics, and
/// of the paper's cup its lengths.
struct LaboratoryRig {
  std::string sensor_model;
  double height_m = 0.0;
  double pitch_rad = 0.0;  ///< 0: horizontal, π/2: straight down
  double roll_rad = 0.0;
  double baseline_m = 0.075;
  double focal_px = 570.342;
  double disparity_offset_px = 0.0;
  std::filesystem::path unit;  ///< unit.json of fathom calibrate; empty: the sensor was not calibrated

  std::string cup_shape = "paper_cup";
  double cup_height_m = 0.087;
  double inner_radius_m = 0.040;
  double outer_radius_m = 0.043;
  double bottom_m = 0.007;

  std::map<std::string, Json> liquids;  ///< name → a medium's name, or an inline medium
  double fill_sigma_m = 0.0005;
  double placement_sigma_m = 0.0005;
  std::map<std::string, double> sigma;  ///< 1 σ of the value of that key, in the key's unit, e.g. "height_mm" → 0.5
};

/// Throws Error on unknown, missing or impossible values. Only sensor.model, sensor.height_mm, sensor.pitch_deg, cup
/// and liquids must be there, and the lengths of a cup that is not the paper's.
LaboratoryRig read_rig(const std::filesystem::path& path);

}  // namespace fathom
