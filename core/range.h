// Allowed values of a number that comes from outside, and how people say them.
#pragma once

#include <string>

namespace fathom {

/// From `low` to `high`, both inside; `open_low` excludes the lower end. Beyond ±1e300 there is no limit to speak of.
struct Range {
  double low = -1e300;
  double high = 1e300;
  bool open_low = false;

  /// False for infinities and NaN.
  bool contains(double number) const;
  /// "a number above 0", "a number from 0 to 90"
  std::string text() const;
};

/// From `low` to `high`.
struct Interval {
  double low, high;
};

inline constexpr Range kPositive{0.0, 1e300, true};
inline constexpr Range kNonNegative{0.0, 1e300, false};

}  // namespace fathom
