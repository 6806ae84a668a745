// Where light that dives into a turbid liquid comes out again, on the whole: a walk of photons, and its far field.
#pragma once

namespace fathom::blind {

/// How far a dot is displaced by its light's first way in the liquid, along the beam, and by its last one, along the
/// line to the sensor, each [m] per sine in air. Of all light that returns in one direction that is sin θ / (n μs′) or
/// a little less (of what returns in any: Wang & Jacques 1995); a matcher weighs what is near the dot's core, here by a
/// Gaussian of `core` [m], and that share comes from a Monte Carlo of isotropic scattering.
double turbid_shift(double index, double reduced_scattering, double core);

/// Share of the light that leaves within the core: what is left of a dot's contrast.
double turbid_contrast(double reduced_scattering, double core);

}  // namespace fathom::blind
