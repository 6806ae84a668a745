#include "sim/scene/optics_model.h"

#include "core/lengths.h"
#include "core/units.h"

namespace fathom {

Eigen::Vector2d OpticsModel::undistorted(const Eigen::Vector2d& seen_at) const {
  // Fixed point: for the distortions that are allowed each round leaves less than a third of the error.
  constexpr int kRounds = 40;
  constexpr double kExact = 1e-16;
  Eigen::Vector2d direction = seen_at;
  for (int round = 0; round < kRounds; ++round) {
    const double squared = direction.squaredNorm();
    const Eigen::Vector2d next = seen_at / (1.0 + squared * (camera_k1 + squared * camera_k2));
    if ((next - direction).squaredNorm() <= kExact * kExact) return next;
    direction = next;
  }
  return direction;
}

OpticsModel optics_from_json(const JsonReader& json, OpticsModel optics) {
  json.allow_only({"f_number", "pixel_um", "focus_mm", "beam_mm", "camera_k1", "camera_k2", "projector_k1"});
  constexpr Range kDistortion{-0.2, 0.2};
  optics.f_number = json.number_or("f_number", optics.f_number, {0.7, 64.0});
  optics.pixel_um = json.number_or("pixel_um", optics.pixel_um, {0.5, 50.0});
  optics.focus = json.metres_or("focus_mm", optics.focus, kLengthOrNoneMm);
  optics.beam = json.metres_or("beam_mm", optics.beam, {0.0, 5.0});
  optics.camera_k1 = json.number_or("camera_k1", optics.camera_k1, kDistortion);
  optics.camera_k2 = json.number_or("camera_k2", optics.camera_k2, kDistortion);
  optics.projector_k1 = json.number_or("projector_k1", optics.projector_k1, kDistortion);
  return optics;
}

Json json_from_optics(const OpticsModel& optics) {
  return {{"f_number", optics.f_number},
          {"pixel_um", optics.pixel_um},
          {"focus_mm", mm_from_metres(optics.focus)},
          {"beam_mm", mm_from_metres(optics.beam)},
          {"camera_k1", optics.camera_k1},
          {"camera_k2", optics.camera_k2},
          {"projector_k1", optics.projector_k1}};
}

}  // namespace fathom
