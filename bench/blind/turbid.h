// Where light that dives into a turbid liquid comes out again, on the whole: a walk of photons, and its far field.
#pragma once

namespace fathom::blind {

/// How far behind the point of entry, along the beam's way, the light is that a matcher takes for the dot [m]. The
/// centroid of all of it is sin θ / (n μs′) (Wang & Jacques 1995); a matcher weighs what is near the dot's core, here
/// by a Gaussian of `core` [m], and that share of the centroid's shift comes from a Monte Carlo of isotropic
/// scattering.
double turbid_shift(double sine_in_air, double index, double reduced_scattering, double core);

/// Share of the light that leaves within the core: what is left of a dot's contrast.
double turbid_contrast(double reduced_scattering, double core);

}  // namespace fathom::blind
