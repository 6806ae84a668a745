// What a sensor of a laboratory reads of its desk.
#pragma once

#include <vector>

#include "core/units.h"
#include "diagnosis/measurement/frame_estimates.h"

namespace fathom {

inline LaboratoryRig laboratory() {
  LaboratoryRig rig;
  rig.height_m = 0.65;
  rig.pitch_rad = radians_from_deg(58.4);
  return rig;
}

/// One point for each square of `step_px`; `error_px` (column, row, true disparity) is what it is read off by.
template <class Error>
std::vector<SensedPoint> desk_points(const LaboratoryRig& rig, double step_px, Error error_px) {
  const Plane desk = plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad});
  const double of_inverse = rig.focal_px * rig.baseline_m;
  std::vector<SensedPoint> points;
  for (double row = 0.5 * step_px; row < kImageHeight_px; row += step_px)
    for (double column = 0.5 * step_px; column < kImageWidth_px; column += step_px) {
      const Eigen::Vector3d sight((column - 0.5 * kImageWidth_px) / rig.focal_px,
                                  (row - 0.5 * kImageHeight_px) / rig.focal_px, 1.0);
      const double true_px = of_inverse * -desk.normal.dot(sight) / desk.offset;
      const double read_px = true_px + error_px(column, row, true_px);
      points.push_back({(of_inverse / read_px * sight).cast<float>(), 100.0f, static_cast<float>(step_px * step_px)});
    }
  return points;
}

}  // namespace fathom
