// Scenes as glTF 2.0, for programs that draw: what read_gltf() reads, and liquids, desk and camera beside it.
#pragma once

#include <string>

#include "sim/scene/setup.h"

namespace fathom {

/// The bytes of a .glb file: desk, cups, liquids, objects and the infrared camera, in metres, +Y up. Clear bodies have
/// transmission, index (at the sensor's wavelength) and absorption; in `extras` what read_gltf() takes from there. A
/// liquid that scatters is opaque. Throws Error when a glTF file of the scene cannot be read or a medium does not hold
/// at that wavelength.
std::string glb_of_scene(const Setup& setup);

/// The same of one cup alone, empty, as it stands at the origin: read as a cup's shape it is that cup again.
std::string glb_of_cup(const Cup& cup, double wavelength_nm);

}  // namespace fathom
