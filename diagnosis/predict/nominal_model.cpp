#include "diagnosis/predict/nominal_model.h"

#include "core/units.h"
#include "sim/scene/medium_json.h"

namespace fathom {

NominalModel nominal_model(const LaboratoryRig& laboratory, const std::string& file) {
  NominalModel model;
  model.laboratory = laboratory;
  const Json sensor = {{"model", laboratory.sensor_model},
                       {"height_mm", mm_from_metres(laboratory.height_m)},
                       {"pitch_deg", deg_from_radians(laboratory.pitch_rad)},
                       {"roll_deg", deg_from_radians(laboratory.roll_rad)},
                       {"baseline_mm", mm_from_metres(laboratory.baseline_m)},
                       {"focal_px", laboratory.focal_px}};
  model.rig = rig_from_json(JsonReader(sensor, file, "/sensor"));
  model.rig.sensor.unit.residue_px = 0.0;  // of this unit it is not known, but learned
  model.rig.sensor.unit.disparity_offset_px = laboratory.disparity_offset_px;
  const Json cup = cup_json_of(laboratory);
  model.cup = cup_shape_from_json(JsonReader(cup, file, "/cup"));
  for (const auto& [name, medium] : laboratory.liquids) {
    const JsonReader json(medium, file, "/liquids/" + name);
    model.liquids[name] = medium_from_json(json);
    model.liquids[name].name = name;  // effects of a liquid go by its label
    require_index(json, model.liquids[name], model.rig.sensor.wavelength_nm);
  }
  return model;
}

Setup setup_of(const NominalModel& model, const Factors& factors) {
  Setup setup{.scene = {}, .rig = model.rig};
  setup.circumstances.time_s = factors.time_s;
  setup.circumstances.stood_s = factors.stood_s;
  setup.circumstances.liquid = factors.liquid;
  for (const auto& [name, medium] : model.liquids) setup.circumstances.liquids.push_back(medium);
  if (factors.liquid == "none") return setup;
  Cup cup{.shape = model.cup,
          .position = {metres_from_mm(factors.lateral_mm), metres_from_mm(factors.distance_mm)},
          .filling = std::nullopt};
  if (factors.liquid != "empty" && factors.fill_mm > 0.0)
    cup.filling = Filling{model.liquids.at(factors.liquid), metres_from_mm(factors.fill_mm)};
  setup.scene.cups.push_back(std::move(cup));
  return setup;
}

}  // namespace fathom
