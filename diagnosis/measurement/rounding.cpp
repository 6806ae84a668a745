#include "diagnosis/measurement/rounding.h"

#include <algorithm>
#include <cmath>

namespace fathom {

double rounding_mm(const std::vector<FrameRecord>& frames) {
  constexpr double kSteps_mm[] = {1.0, 0.5, 0.2, 0.1, 0.05};
  constexpr double kSame = 1e-6;  // steps
  std::vector<double> heights_mm;
  for (const FrameRecord& frame : frames)
    if (frame.cloud.empty() && frame.height_mm) heights_mm.push_back(*frame.height_mm);
  if (heights_mm.empty()) return 0.0;
  for (const double step_mm : kSteps_mm)
    if (std::all_of(heights_mm.begin(), heights_mm.end(), [&](double height_mm) {
          return std::abs(height_mm / step_mm - std::round(height_mm / step_mm)) < kSame;
        }))
      return step_mm / std::sqrt(12.0);
  return 0.0;
}

}  // namespace fathom
