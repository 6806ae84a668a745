// A random desk, shot by the simulated sensor, and templates of the cups that stand on such desks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "detector/cup_template.h"
#include "sim/scene/clutter.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"
#include "trials/trial.h"

namespace fathom {

struct DeskShot {
  Setup setup;
  Camera camera;
  Frame frame;
  LabelledFrame labelled;
  double shoot_s;
};

/// Photometric, direct light. `visible` of a cup: pixels in which it is seen, as a share of those that it would fill
/// alone.
DeskShot shoot_desk(const Json& scene, const std::string& file, std::uint64_t seed);

/// Templates as a laboratory makes them: each kind of cup captured once, empty, alone in the middle of the region's
/// near side, where the most of its bottom is seen, by the same sensor without noise. Kinds that the paper's gates do
/// not take for cups (clear glass, tall mugs) have none.
std::vector<CupTemplate> templates_of(const ClutterSpec& clutter);

}  // namespace fathom
