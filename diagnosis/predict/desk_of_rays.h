// The desk of a few rays, as far as it is no plane: what a unit's bias would be learned from.
#pragma once

#include <vector>

#include "diagnosis/measurement/unit_bias.h"
#include "diagnosis/predict/surrogate.h"

namespace fathom {

/// A DeskError: the points' disparities off their own plane, between pixels bilinear.
class DeskOfRays {
 public:
  DeskOfRays(std::span<const SensedPoint> desk, const LaboratoryRig& rig);

  std::optional<double> operator()(const BiasCell& cell) const;

 private:
  std::vector<double> errors_px_;  ///< on the raster of kDeskColumns × kDeskRows; NaN where no desk is seen
};

}  // namespace fathom
