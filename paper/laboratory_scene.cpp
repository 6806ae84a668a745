#include "paper/laboratory_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "campaign/campaign_spec.h"

namespace fathom {
namespace {

constexpr const char* kName = "the paper's scene";

}  // namespace

std::string PaperFilling::label() const {
  if (liquid == "empty") return liquid;
  std::string name = liquid;
  std::replace(name.begin(), name.end(), '_', ' ');
  return fmt::format("{} {:g} mm", name, fill_mm);
}

Setup paper_setup(const PaperFilling& filling, double distance_mm) {
  Json cup = {{"shape", "paper_cup"}, {"position_mm", {0.0, distance_mm}}};
  if (filling.liquid != "empty") {
    cup["liquid"] = filling.liquid;
    cup["fill_mm"] = filling.fill_mm;
  }
  return setup_from_json(
      {{"sensor", {{"model", "xtion_pro_live"}, {"height_mm", kPaperHeightMm}, {"aim_mm", {0, 400, 0}}}},
       {"cups", Json::array({cup})}},
      kName);
}

LaboratoryRig paper_rig(const Setup& setup) {
  return nominal_rig(setup.rig, std::get<CupShape>(setup.scene.cups.front().shape), kName);
}

double water_index_at_sensor() {
  const Setup setup = paper_setup({"water", 10.0}, 400.0);
  return setup.scene.cups.front().filling->medium.n(setup.rig.sensor.wavelength_nm);
}

}  // namespace fathom
