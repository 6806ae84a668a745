// What a frame says of a desk, and where it cannot.
#include "diagnosis/measurement/frame_estimates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace fathom {
namespace {

/// A desk 0.7 m below a sensor on which ten rows are half a pixel of disparity apart: f b cos(pitch) / (f h).
std::vector<SensedPoint> desk_of_rows(const LaboratoryRig& rig, int every) {
  std::vector<SensedPoint> points;
  for (int row = every / 2; row < 480; row += every)
    for (int column = 0; column < 640; column += every) {
      const double u = (column + 0.5 - 320.0) / rig.focal_px, v = (row + 0.5 - 240.0) / rig.focal_px;
      const double z = rig.height_m / (std::sin(rig.pitch_rad) + v * std::cos(rig.pitch_rad));
      points.push_back({(z * Eigen::Vector3d(u, v, 1.0)).cast<float>(), 0.0f});
    }
  return points;
}

/// Codes of 1/2 px show where disparities stand: not where rows do so by themselves.
TEST(FrameEstimates, TellNothingOfCodesWhereRowsAreWholeCodesApart) {
  LaboratoryRig rig;
  rig.height_m = 0.700;
  rig.pitch_rad = std::acos(0.05 * rig.height_m / rig.baseline_m);
  const auto spans_codes = [&](int every) { return estimate_frame(desk_of_rows(rig, every), rig, {})->spans_codes; };
  EXPECT_TRUE(spans_codes(1));
  EXPECT_TRUE(spans_codes(7));
  EXPECT_FALSE(spans_codes(10));
}

}  // namespace
}  // namespace fathom
