#include "sim/effects/changes.h"

namespace fathom {

void for_each_filling(Setup& setup, const EffectSetting& setting, const std::function<void(Cup&, Filling&)>& change) {
  for (Cup& cup : setup.scene.cups) {
    if (!cup.filling) continue;
    const std::string& label =
        setup.circumstances.liquid.empty() ? cup.filling->medium.name : setup.circumstances.liquid;
    if (setting.liquid.empty() || setting.liquid == label) change(cup, *cup.filling);
  }
}

void for_each_cup(Setup& setup, const std::function<void(Cup&, CupShape&)>& change) {
  for (Cup& cup : setup.scene.cups)
    if (CupShape* shape = std::get_if<CupShape>(&cup.shape)) change(cup, *shape);
}

void turn_camera(Rig& rig, const Eigen::Matrix3d& turn_in_world) {
  const double half = 0.5 * rig.sensor.baseline;
  const Eigen::Vector3d midpoint = rig.camera_in_world() + half * rig.world_from_camera.linear().col(0);
  rig.world_from_camera.linear() = turn_in_world * rig.world_from_camera.linear();
  rig.world_from_camera.translation() = midpoint - half * rig.world_from_camera.linear().col(0);
}

void keep_calibration(SensorModel& sensor) { sensor.believed = sensor.calibration(); }

}  // namespace fathom
