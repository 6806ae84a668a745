// A device that `fathom calibrate` has seen, and its clouds without the bias that was found.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>

#include "core/unit_map.h"
#include "diagnosis/unit/calibration_view.h"

namespace fathom {

class CalibratedUnit {
 public:
  /// Of its unit.json. Throws Error.
  explicit CalibratedUnit(const std::filesystem::path& file);

  /// Moves points [m], in the frame of the camera of its clouds, along their lines of sight to where the device would
  /// have measured them without its bias. NaN stays.
  void take_off_bias(std::span<Eigen::Vector3f> points) const;

 private:
  LearnedUnit unit_;
  DeviceScale scale_;
};

}  // namespace fathom
