// Reflectance and transmittance of turbid slabs by adding and doubling: no random numbers, and no code of the
// simulator's.
#pragma once

namespace fathom::reference {

struct Slab {
  double n = 1.0;          ///< index, in air
  double albedo = 0.9;     ///< μs / (μa + μs)
  double thickness = 1.0;  ///< optical: (μa + μs) times the geometrical one
  double g = 0.0;          ///< of the Henyey–Greenstein phase function
};

struct SlabLight {
  double reflectance;    ///< total, specular reflection included
  double transmittance;  ///< total
};

/// For a collimated, unpolarised beam that arrives in air with the given cosine of incidence ∈ (0, 1].
/// `angles`: quadrature points of a hemisphere; the phase function keeps as many Legendre terms, the rest of its
/// forward peak counts as unscattered (delta-M, Wiscombe 1977). van de Hulst, A New Look at Multiple Scattering, 1963;
/// Prahl, van Gemert & Welch, Appl. Opt. 32, 1993.
SlabLight adding_doubling(const Slab& slab, double cos_incidence, int angles);

}  // namespace fathom::reference
