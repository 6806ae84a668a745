// The default method: round upright walls, found one by one in what stands together; lines of sight tell what is open
// at the top; what is level inside is a bottom, a raised bottom or a surface by a test between hypotheses.
#pragma once

#include "detector/detector.h"

namespace fathom {

Detection detect_robust(const Cloud& cloud, const DetectorSettings& settings);

}  // namespace fathom
