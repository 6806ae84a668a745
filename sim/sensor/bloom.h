// Blooming: light above full scale spills to the pixels around.
#pragma once

#include "core/image.h"

namespace fathom {

/// Spreads `share` of what every pixel holds above `full_scale` over its surroundings, exponentially with a mean
/// distance of `reach` pixels along each axis; nothing of that share is lost but at the image's edges. The pixel keeps
/// the rest.
void bloom(double full_scale, double share, double reach, Image<float>& image);

}  // namespace fathom
