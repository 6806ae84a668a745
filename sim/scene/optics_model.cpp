#include "sim/scene/optics_model.h"

#include "core/fields.h"
#include "core/range.h"

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

std::span<const Field<OpticsModel>> optics_fields() {
  constexpr Range kDistortion{-0.2, 0.2};
  static const Field<OpticsModel> fields[] = {
      {"f_number",
       &OpticsModel::f_number,
       {0.7, 64.0},
       "of the infrared camera, whose speckle has grains of the wavelength times this"},
      {"pixel_um", &OpticsModel::pixel_um, {0.5, 50.0}, "pitch of the infrared camera's pixels"},
      {"focus_mm", Length{&OpticsModel::focus}, kLengthOrNoneMm, "distance that the camera sees sharply; 0: all"},
      {"beam_mm",
       Length{&OpticsModel::beam},
       {0.0, 5.0},
       "width (4 standard deviations) of the projector's beams where they leave it; 0: rays"},
      {"camera_k1", &OpticsModel::camera_k1, kDistortion,
       "radial distortion of the camera; negative: barrel. Clouds are made as if there were none, as the device does"},
      {"camera_k2", &OpticsModel::camera_k2, kDistortion, "the same, with the fourth power of the radius"},
      {"projector_k1", &OpticsModel::projector_k1, kDistortion,
       "radial distortion of the projected pattern; positive: pincushion"}};
  return fields;
}

}  // namespace fathom
