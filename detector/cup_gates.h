// Which segments could be cups: their size, and the circle they show at 40–50 mm above the desk. Paper, section V-D.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/circle.h"
#include "detector/cloud.h"

namespace fathom {

struct CupGates {
  double width_min_m =
      0.030;  ///< end to end along the desk; the paper gives no numbers: a bit less than 2 × radius_min …
  double width_max_m = 0.170;  ///< … and 2 × radius_max with 50 mm for a handle
  double top_min_m = 0.040;    ///< the segment must reach into the band
  double band_low_m = 0.040;   ///< points between these heights are projected onto the desk
  double band_high_m = 0.050;
  /// As printed. It rejects nothing: no circle of 60 mm radius has points 40 mm off on the average. Mugs show 1.4–2.0
  /// mm, or 7–9 mm with the handle in the band; other things 9–58 mm.
  double circle_rms_max_m = 0.040;
  double radius_min_m = 0.020;
  double radius_max_m = 0.060;
};

/// A segment and what was seen of a cup in it. Desk frame.
struct CupCandidate {
  Points points;
  double width_m = 0.0;  ///< largest distance end to end along the desk, to 0.1 %
  double top_m = 0.0;    ///< highest point above the desk
  int band_points = 0;
  std::optional<Circle> circle;
  std::optional<double> lean{};  ///< change of the wall's radius with the height, where the method knows it
  std::string rejected;          ///< why this is no cup; empty while it may be one
};

/// Measures the segment and rejects it at the first gate it fails.
CupCandidate examine_segment(Points segment, const CupGates& gates);

}  // namespace fathom
