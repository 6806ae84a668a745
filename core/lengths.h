// Lengths and places that files may give [mm]: up to a kilometre. Everything that this program is about is a thousand
// times smaller; at a thousand times more, floats of the ray tracer are no longer apart by less than a millimetre.
#pragma once

#include "core/range.h"

namespace fathom {

inline constexpr Range kLengthMm{0.0, 1e6, true};
inline constexpr Range kLengthOrNoneMm{0.0, 1e6};
inline constexpr Range kPlaceMm{-1e6, 1e6};

}  // namespace fathom
