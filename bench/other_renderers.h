// The infrared image of a few dots as other renderers make it, which run as programs of their own.
#pragma once

#include <string>

#include "tests/sensor/sparse_dots.h"

namespace fathom {

struct Rendering {
  Image<float> image;  ///< in a unit of the renderer's own, with the size of the dots' infrared image
  double cpu_s;        ///< processor time of all threads
  double wall_s;
};

/// Whether a program stands in PATH.
bool is_installed(const std::string& program);

/// POV-Ray with about so many photons sent towards the water, 4 samples per pixel. The times are those of the whole
/// program. Throws Error with what it said when it fails; the next one as well.
Rendering render_with_povray(const SparseDots& dots, int photons);

/// Blender's Cycles with shadow caustics, with so many samples per pixel. The times are those of the rendering alone;
/// the program's start takes a second or two.
Rendering render_with_cycles(const SparseDots& dots, int samples_per_pixel);

}  // namespace fathom
