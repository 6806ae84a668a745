// A calibrated device's bias, taken off clouds that nobody compares with a model.
#include "diagnosis/measurement/calibrated_unit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "diagnosis/unit/calibration.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

float of_reference_px(double column_px) { return static_cast<float>(0.3 * std::sin(column_px / 60.0)); }
float of_camera_px(double row_px) { return static_cast<float>(0.1 * std::cos(row_px / 50.0)); }

UnitCalibration waves(double camera_m) {
  UnitCalibration unit;
  unit.scale.camera_m = camera_m;
  const Image<float> empty(640, 480);
  unit.bias_px = unit.sigma_px = unit.reference_px = unit.camera_px = empty;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      unit.reference_px(x, y) = of_reference_px(x);
      unit.camera_px(x, y) = of_camera_px(y);
    }
  return unit;
}

/// A wall at a distance as such a device measures it, and as it is.
struct Wall {
  std::vector<Eigen::Vector3f> measured, real;
};

Wall wall(const DeviceScale& scale, double z) {
  const double of_inverse = scale.focal_px * scale.baseline_m, nearer_px = of_inverse / z - of_inverse / 1.2;
  Wall result;
  for (int y = 8; y < 480; y += 16)
    for (int x = 108; x < 540; x += 16) {
      const double bias_px = of_reference_px(x - nearer_px) + of_camera_px(y),
                   read_m = of_inverse / (of_inverse / z + bias_px);
      for (const auto& [points, depth] : {std::pair{&result.measured, read_m}, std::pair{&result.real, z}})
        points->push_back(Eigen::Vector3d((x - 320.0) / scale.focal_px * depth - scale.camera_m,
                                          (y - 240.0) / scale.focal_px * depth, depth)
                              .cast<float>());
    }
  return result;
}

TEST(CalibratedUnit, ItsBiasIsTakenOffWhateverCameraItsCloudsBelongTo) {
  for (const double camera_m : {0.0, 0.025})
    for (const double z : {0.6, 0.9}) {
      const TemporaryFolder folder;
      const UnitCalibration unit = waves(camera_m);
      write_unit(folder / "", unit);
      Wall seen = wall(unit.scale, z);
      const auto largest_mm = [&] {
        float most = 0.0f;
        for (std::size_t i = 0; i < seen.real.size(); ++i)
          most = std::max(most, std::abs(seen.measured[i].z() - seen.real[i].z()));
        return 1e3f * most;
      };
      const float before_mm = largest_mm();
      seen.measured.emplace_back(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
      CalibratedUnit(folder / "unit.json").take_off_bias(seen.measured);
      EXPECT_TRUE(std::isnan(seen.measured.back().z()));
      EXPECT_GT(before_mm, 2.5f);
      // The map is read by whole pixels: to the next one it changes by 0.007 px of the 0.4.
      EXPECT_LT(largest_mm(), 0.02f * before_mm) << camera_m << " " << z;
    }
}

TEST(CalibratedUnit, AFileWithoutItsDeviceIsRefused) {
  const TemporaryFolder folder;
  write_unit(folder / "", waves(0.0));
  write_text(folder / "unit.json", R"({"bias": {"image": "unit_bias.exr", "reference_at_px": 0}})");
  EXPECT_THROW(CalibratedUnit{folder / "unit.json"}, Error);
  EXPECT_THROW(CalibratedUnit{folder / "nothing.json"}, Error);
}

}  // namespace
}  // namespace fathom
