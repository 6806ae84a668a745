#include "trials/clutter_templates.h"

#include "core/error.h"
#include "core/units.h"
#include "detector/make_template.h"
#include "sim/scene/cup.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"
#include "trials/trial.h"

namespace fathom {

std::vector<CupTemplate> templates_of(const ClutterSpec& clutter) {
  std::vector<CupTemplate> templates;
  for (const ClutterThing& kind : clutter.cup_kinds) {
    Json cup = kind.entry;
    cup["position_mm"] = {mm_from_metres(clutter.region.center().x()), mm_from_metres(clutter.region.min().y())};
    Setup setup = setup_from_json({{"sensor", clutter.sensor}, {"desk", clutter.desk}, {"cups", {cup}}}, clutter.file);
    setup.rig.sensor.noise = {};
    const Frame frame = Camera(setup, CaptureMode::geometric, 1, 0).shoot(0);
    try {
      templates.push_back(template_of_only_cup(cup_name(setup.scene.cups.front()), cloud_from_image(frame.cloud),
                                               prior_of(setup.rig.world_from_camera), std::nullopt, "template's desk"));
    } catch (const Error&) {
      continue;
    }
  }
  return templates;
}

}  // namespace fathom
