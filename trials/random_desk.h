// A random desk, shot by the simulated sensor.
#pragma once

#include <cstdint>
#include <string>

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

/// Photometric, direct light. `visible` of a cup is the share of the pixels that it would fill alone on the desk.
DeskShot shoot_desk(const Json& scene, const std::string& file, std::uint64_t seed);

}  // namespace fathom
