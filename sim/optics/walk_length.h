// How long random walks through a slab get: what it costs to sample them, known before the first one.
#pragma once

#include "sim/optics/layers.h"

namespace fathom {

/// Scatterings and reflections that a walk of light_in_layers() takes on average, for a beam at `angle` [rad] to the
/// normal of one layer in air; an estimate that lies above the truth, by less than a factor of 100.
///
/// Light that fills a slab of thickness d evenly has a mean path of 2 d / T, whatever scatters in it (T: the diffuse
/// transmittance of a face from inside), so it scatters 2 μs d / T times and meets a face 1 / T times. Absorption keeps
/// it within some lengths of diffusion 1/√(3 μa (μa + μs (1 − g))) below the surface. Light that scatters beyond the
/// angle of total reflection meets faces until it scatters again, 1 / (d (μs + μa)) times. 0 where no light enters.
double expected_steps(const Layer& slab, double angle);

}  // namespace fathom
