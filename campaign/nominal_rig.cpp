#include "campaign/nominal_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/library.h"

namespace fathom {

LaboratoryRig nominal_rig(const Rig& rig, const CupShape& cup, const std::string& file) {
  const Eigen::Matrix3d world_from_camera = rig.world_from_camera.linear();
  const Eigen::Vector3d forward = world_from_camera.col(2);
  if (rig.sensor.name.empty())
    throw Error(file, "/sensor/model",
                fmt::format("is missing: a measurement's rig names its sensor, choose from {}; other keys change it",
                            fmt::join(library_names("sensors"), ", ")));
  constexpr double kRounding = 1e-9;
  if (std::abs(forward.x()) > kRounding || forward.y() < -kRounding)
    throw Error(file, "/sensor/aim_mm", "must lie straight ahead (x = 0, y ≥ 0): a measurement's rig knows no yaw");
  LaboratoryRig nominal;
  nominal.sensor_model = rig.sensor.name;
  nominal.height_m = 0.5 * (rig.camera_in_world() + rig.projector_in_world()).z();
  nominal.pitch_rad = std::atan2(-forward.z(), forward.y());
  nominal.roll_rad = roll_of(world_from_camera);
  nominal.baseline_m = rig.sensor.baseline;
  nominal.focal_px = rig.sensor.focal_px;
  nominal.cup_shape = cup.name;
  nominal.cup = cup;
  return nominal;
}

}  // namespace fathom
