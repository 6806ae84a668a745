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

/// Lengths and places that files may give [mm]: up to a kilometre. Everything that this program is about is a thousand
/// times smaller; at a thousand times more, floats of the ray tracer are no longer apart by less than a millimetre.
inline constexpr Range kLengthMm{0.0, 1e6, true};
inline constexpr Range kLengthOrNoneMm{0.0, 1e6};
inline constexpr Range kPlaceMm{-1e6, 1e6};

}  // namespace fathom
