// What several effects need: the cups, fillings and camera of a set-up, ready to be changed.
#pragma once

#include <functional>

#include "sim/effects/effect.h"

namespace fathom {

/// Every filling that the setting is about: of all liquids, or of the one with that label.
void for_each_filling(Setup& setup, const EffectSetting& setting, const std::function<void(Cup&, Filling&)>& change);

/// Every cup of revolution. A cup from a glTF file has no numbers that could change.
void for_each_cup(Setup& setup, const std::function<void(Cup&, CupShape&)>& change);

/// Turns the camera about the baseline's midpoint, the turn given in the world.
void turn_camera(Rig& rig, const Eigen::Matrix3d& turn_in_world);

/// What the device takes for its own numbers is what they are now, whatever they become.
void keep_calibration(SensorModel& sensor);

}  // namespace fathom
