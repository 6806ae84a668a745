// What a simulated measurement campaign varies, as its file says it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.h"
#include "diagnosis/measurement/laboratory_rig.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"

namespace fathom {

struct CampaignFilling {
  std::string liquid;  ///< "empty", or a key of the liquids
  Medium medium;       ///< of a liquid
  double fill = 0.0;   ///< [m], as the laboratory means to pour it; 0 when empty
};

struct CampaignSpec {
  Json source;  ///< the file's text
  Rig rig;
  Desk desk;
  CupShape cup;
  LaboratoryRig nominal;      ///< what the laboratory believes, for rig.json
  std::vector<Medium> media;  ///< of the liquids, in the order of their names
  std::vector<CampaignFilling> fillings;
  std::vector<double> distances, laterals{0.0};  ///< [m]
  int sessions = 1;                              ///< each of them pours and places everything anew
  int bare_desk_views = 0;                       ///< shots of the desk without a cup when a session begins
  int pours = 1, placements = 1, trials = 10;    ///< pours of each filling, placements at each place, shots of each
  double frame_s = 1.0, placement_s = 0.0, pour_s = 0.0;  ///< what a shot takes, and putting down and pouring besides
  Json effects = Json::array();                           ///< that the model of the laboratory does not know
  CaptureMode mode = CaptureMode::photometric;

  /// Of all sessions; more than an integer holds where the file asks for it.
  double frames() const {
    const double places = static_cast<double>(distances.size()) * static_cast<double>(laterals.size()) * placements;
    return sessions * (bare_desk_views + static_cast<double>(fillings.size()) * pours * places * trials);
  }
  double deepest_fill() const { return cup.height() - cup.bottom(); }
};

/// What a laboratory would write down about a simulated sensor and cup: the rig without any liquids. A measurement
/// directory names its sensor's model and cannot say that the sensor looks aside: throws Error, as coming from `file`,
/// when the rig has no model or a yaw.
LaboratoryRig nominal_rig(const Rig& rig, const CupShape& cup, const std::string& file);

/// Throws Error naming file, path, what is wrong and what is allowed.
CampaignSpec read_campaign_spec(const std::filesystem::path& path);

/// The file's objects.
std::vector<KeyTable> campaign_key_tables();

}  // namespace fathom
