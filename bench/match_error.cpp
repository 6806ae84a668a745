#include "bench/match_error.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace fathom {

MatchError match_error(const StereoPair& pair, const Image<float>& disparity_px) {
  const MatcherModel& matcher = pair.sensor.matcher;
  const int half_columns = matcher.window_columns / 2, half_rows = matcher.window_rows / 2;
  const int first = std::max(matcher.disparity_max_px, 0) + half_columns;
  const int last = disparity_px.width() - 1 + std::min(matcher.disparity_min_px, 0) - half_columns;
  double lit = 0, inliers = 0, squares = 0;
  std::vector<double> errors;
  for (int y = half_rows; y < disparity_px.height() - half_rows; ++y)
    for (int x = first; x <= last; ++x) {
      if (std::isnan(pair.true_disparity_px(x, y))) continue;
      ++lit;
      if (std::isnan(disparity_px(x, y))) continue;
      const double error = std::fabs(disparity_px(x, y) - pair.true_disparity_px(x, y));
      errors.push_back(error);
      if (error >= 1.0) continue;
      ++inliers;
      squares += error * error;
    }
  if (inliers == 0) return {};
  const double valid = static_cast<double>(errors.size());
  return {valid / lit, median(std::move(errors)), std::sqrt(squares / inliers), 1.0 - inliers / valid};
}

}  // namespace fathom
