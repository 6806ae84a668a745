// The paper's table, cup and sensor, where its text says so, and our assumptions where it does not.
#pragma once

#include <string>

#include "diagnosis/measurement/laboratory_rig.h"
#include "sim/scene/setup.h"

namespace fathom {

struct PaperFilling {
  std::string liquid;  ///< "empty" or a name from scenes/media
  double fill_mm;

  std::string label() const;  ///< "milk tea 30 mm"
};

inline constexpr double kPaperIndex = 1.333;     ///< "the relative refractive index 1.333 of water to air"
inline constexpr double kPaperHeightMm = 650.0;  ///< of the sensor above the desk: an assumption
inline constexpr double kPaperBottomMm = 7.0;    ///< of the cup, above the desk: an assumption

/// The cup on the sensor's middle line, the sensor aimed at (0, 400 mm, 0).
Setup paper_setup(const PaperFilling& filling, double distance_mm);

LaboratoryRig paper_rig(const Setup& setup);

/// Of water, at the sensor's wavelength.
double water_index_at_sensor();

}  // namespace fathom
