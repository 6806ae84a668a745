// The method as printed: Hara, Honda, Tsubouchi & Ohya, IROS 2014, section V.
#pragma once

#include "detector/detector.h"

namespace fathom {

Detection detect_paper(const Cloud& cloud, const DetectorSettings& settings);

}  // namespace fathom
