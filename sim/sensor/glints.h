// The projector's own mirror images in the infrared image.
#pragma once

#include "core/image.h"
#include "sim/render/light.h"
#include "sim/scene/rig.h"
#include "sim/sensor/pattern.h"

namespace fathom {

/// Adds the mirror images of the projector in liquids and glass to an image [DN]. A point's image is as blurred as a
/// dot; its power is that which the pinhole receives, of the pattern's intensity in the one direction that is mirrored.
void add_glints(const PointLight& projector, const Rig& rig, const Pattern& pattern, Image<float>& image);

}  // namespace fathom
