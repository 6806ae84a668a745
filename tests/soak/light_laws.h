// Light is neither made nor counted twice on its way from the projector to what the camera sees.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/render/connection.h"
#include "sim/scene/rig.h"

namespace fathom {

struct TubeCounts {
  std::uint64_t held = 0;  ///< thin tubes of light of which the laws were asked
  std::uint64_t torn = 0;  ///< those that fall apart at an edge, of which they say nothing
};

/// One sentence for every law that the light of a scene breaks, at the point that each depth pixel sees:
///   - no way passes on more than it gets: transmittances, and radiance · n² towards the camera, are from 0 to 1;
///   - a way ends where it says: a ray sent out in its direction arrives at the point;
///   - a thin tube of rays about it lights an area that takes up all its power and no more: rays sent out a
///     microradian to each side land 1 / spreading apart, in area per solid angle;
///   - each direction leads to a point once: no two ways are one.
/// So what all points receive together is what the projector sends out, less what is lost, however light is focused.
/// The rays are traced by see(), which knows no pencils, fans or roots: only Snell's law at one surface after another.
std::vector<std::string> broken_light_laws(const PointLight& projector, const Rig& rig, TubeCounts& counts);

}  // namespace fathom
