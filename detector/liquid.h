// The height of what is seen inside a cup: its bottom, its raised bottom or a liquid's surface. Paper, section V-E.
#pragma once

#include <optional>

#include "detector/circle.h"
#include "detector/cloud.h"

namespace fathom {

enum class Liquid { kNo, kYes, kUnknown };

struct InteriorSettings {
  double margin_m = 0.010;  ///< points count whose distance from the axis is below the radius by this
  double low_m = -0.010;    ///< what reads deeper below the desk than the desk's own scatter is no cup's bottom
  double high_m = 0.100;    ///< nor is what stands higher than the tallest cup
  int points_min = 10;      ///< fewer are no evidence
};

struct InteriorHeight {
  double mean_m;  ///< above the desk
  double sd_m;    ///< of the points
  int points;

  /// Of the mean, as if the points' errors were independent. Neighbours share theirs, so this is a lower limit.
  double standard_error_m() const;
};

/// `points` [m, desk frame] are the whole scene's: a bottom within the desk's threshold belongs to no segment.
/// Nothing when fewer than `points_min` are inside.
std::optional<InteriorHeight> interior_height(const Points& points, const Circle& circle,
                                              const InteriorSettings& settings);

/// A liquid, if the height is above the threshold (the height of the empty cup's bottom); unknown when nothing was
/// seen.
Liquid decide_liquid(const std::optional<InteriorHeight>& height, double threshold_m);

}  // namespace fathom
