#include "campaign/next_campaign.h"

#include "core/json.h"

namespace fathom {

Json campaign_of(const MeasurementPlan& plan, const LaboratoryRig& rig) {
  const Json nominal = json_from_laboratory_rig(rig);
  Json spec;
  for (const char* key : {"model", "height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px"})
    spec["sensor"][key] = nominal["sensor"][key];
  spec["cup"]["shape"] = cup_json_of(rig);
  spec["liquids"] = nominal["liquids"];
  for (const auto& [label, medium] : plan.media) spec["liquids"][label] = medium;
  spec["fillings"] = Json::array();
  for (const auto& [liquid, fill_mm] : plan.fillings) {
    Json filling{{"liquid", liquid}};
    if (fill_mm > 0.0) filling["fill_mm"] = fill_mm;
    spec["fillings"].push_back(std::move(filling));
  }
  spec["distance_mm"] = plan.distances_mm;
  spec["lateral_mm"] = plan.laterals_mm;
  spec["bare_desk_views"] = plan.bare_desk_views;
  spec["pours"] = plan.pours;
  spec["placements"] = plan.placements;
  spec["trials"] = plan.trials;
  spec["placement_s"] = plan.wait_s();
  spec["fill_sigma_mm"] = nominal["fill_sigma_mm"];
  spec["placement_sigma_mm"] = nominal["placement_sigma_mm"];
  return spec;
}

}  // namespace fathom
