// A laboratory's sensor and cup, as it believes them: rig.json of a measurement directory.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/cup_profile.h"
#include "core/json_fwd.h"
#include "core/unit_map.h"

namespace fathom {

/// Of the images that a rig's focal length is for.
inline constexpr double kImageWidth_px = 640.0, kImageHeight_px = 480.0;

/// Lengths in metres, angles in radians. What the file does not give keeps its default: the sensor model's optics, and
/// the paper's cup.
struct LaboratoryRig {
  std::string sensor_model;
  double height_m = 0.0;
  double pitch_rad = 0.0;  ///< 0: horizontal, π/2: straight down
  double roll_rad = 0.0;
  double baseline_m = 0.075;
  double focal_px = 570.342;
  double disparity_offset_px = 0.0;
  LearnedUnit unit;  ///< of fathom calibrate; empty: the sensor was not calibrated

  std::string cup_shape = "paper_cup";  ///< a name of scenes/cups, or the laboratory's own
  CupProfile cup = straight_cup(0.087, 0.007, 0.040, 0.043);

  std::map<std::string, SharedJson> liquids;  ///< name → a medium's name, or an inline medium
  double fill_sigma_m = 0.0005;
  double placement_sigma_m = 0.0005;
  /// By how much all lengths and all angles of a session may differ from another's beyond the pose's uncertainty, 1 σ.
  /// Nothing in a session moves them together but the sensor's pose, so little is left: a tenth of what a single shot
  /// of a region scatters by.
  double session_m = 0.0001, session_rad = 0.0002;
  std::map<std::string, double> sigma;  ///< 1 σ of the value of that key, in the key's unit, e.g. "height_mm" → 0.5
};

/// A value of the rig whose standard deviation a laboratory may state. An effect with one parameter, in the same unit,
/// moves it.
struct RigValue {
  const char* key;
  double usual_sigma;                ///< in the key's unit, where none is stated
  double LaboratoryRig::*of_sensor;  ///< null: the cup's
  const char *effect, *parameter;
  bool is_pose;  ///< set up anew for each session
};
inline constexpr RigValue kRigValues[] = {
    {"height_mm", 0.5, &LaboratoryRig::height_m, "sensor_height", "height_mm", true},
    {"pitch_deg", 0.05, &LaboratoryRig::pitch_rad, "sensor_pitch", "pitch_deg", true},
    {"roll_deg", 0.05, &LaboratoryRig::roll_rad, "sensor_roll", "roll_deg", true},
    {"baseline_mm", 0.05, &LaboratoryRig::baseline_m, "baseline", "baseline_mm", false},
    {"focal_px", 0.4, &LaboratoryRig::focal_px, "focal_length", "focal_px", false},
    {"disparity_offset_px", 0.02, &LaboratoryRig::disparity_offset_px, "disparity_offset", "offset_px", false},
    {"bottom_mm", 0.1, nullptr, "cup_bottom_height", "height_mm", false}};

/// The shape of a cup of scenes/cups; nothing where that has no such cup. Throws Error when its file is wrong.
std::optional<CupProfile> library_cup(const std::string& name);

/// Whether the rim and both walls are the same to a micrometre; a rig's lengths are written to the nanometre.
bool is_same_cup(const CupProfile& a, const CupProfile& b);

/// The cup as a scene has it: the library's, where the rig's is that one, with its albedo and handle; else by the rig's
/// profiles or lengths.
Json cup_json_of(const LaboratoryRig& rig);

/// Throws Error on unknown, missing or impossible values. Only sensor.model, sensor.height_mm, sensor.pitch_deg, cup
/// and liquids must be there. A cup is one of scenes/cups by `shape`, or described by its profiles or its lengths.
/// Lengths beside a cup of scenes/cups stand for those of its own if it is straight, else they must be the same.
LaboratoryRig laboratory_rig_from_json(const JsonReader& json);
LaboratoryRig read_rig(const std::filesystem::path& path);

/// rig.json, as read_rig reads it, with numbers to a millionth.
Json json_from_laboratory_rig(const LaboratoryRig& rig);

/// The object `json` of standard deviations of these keys, in the keys' units.
void read_sigmas(const JsonReader& json, std::span<const std::string_view> keys, std::map<std::string, double>& sigma);

/// An object of media by label: a medium's name each, or an inline medium. "empty" and "none" are no labels.
std::map<std::string, SharedJson> media_by_label(const JsonReader& json);

/// The keys of standard deviations, and the objects of rig.json.
std::vector<KeyRow> sigma_keys();
std::vector<KeyTable> rig_key_tables();

}  // namespace fathom
