// Where the light of an oblique beam seems to come from, a few transport mean free paths from where it entered: the
// quantity by which oblique-incidence reflectometry measures μs′.
#pragma once

#include <cstdint>

#include "core/sampling.h"
#include "sim/optics/random_walk.h"

namespace fathom {

/// Distance [m], from a beam's entry into a half-space, of the point that is the centroid of the reflected light around
/// itself: ∫ (x − c) h(|r − c|) R(r) dA = 0 with a weight h that rises from 0 to 1 between 2 and 5 transport mean free
/// paths. Diffusion theory says c = sin θ / (n μs′), or with μs′ + 0.35 μa where absorption counts (Wang & Jacques,
/// Applied Optics 34, 1995).
/// The beam falls from air at `angle` ∈ (0, π/2) [rad] to the normal. The medium scatters and absorbs.
Estimate far_centroid(const Turbid& medium, double angle, std::uint64_t seed, const SamplingPlan& plan);

}  // namespace fathom
