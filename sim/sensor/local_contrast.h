// Brightness freed from what illuminates it: what the matcher's search compares.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sim/scene/rig.h"
#include "sim/sensor/reference.h"

namespace fathom {

/// Deviation from the mean of the matcher's window over its standard deviation (at least `contrast_min`), scaled so
/// that a window's sum of products fits 16 bits. Frames the columns by `frame` zeros on each side, an even number.
SplitColumns<std::int16_t> locally_normalised(const Image<float>& image, const MatcherModel& matcher, int frame);

}  // namespace fathom
