// How a device's disparities drift after it was switched on, from desks of one pose at known times.
#pragma once

#include <optional>
#include <span>

namespace fathom {

struct WarmUp {
  double warm_up_px;  ///< too much at time 0, falling to 1/e in …
  double warm_up_s;
  double sigma_px;  ///< 1 σ of the first, the time not known
};

/// Mean disparity of one plane at a time.
struct TimedDisparity {
  double time_s, disparity_px;
};

/// Least squares. Nothing of fewer than five times, nor where the first is less than three sigma: a device that does
/// not warm up, or times that begin when it has.
std::optional<WarmUp> warm_up_of(std::span<const TimedDisparity> readings);

}  // namespace fathom
