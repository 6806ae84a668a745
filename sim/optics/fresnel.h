// Fresnel's equations for unpolarised light at a smooth dielectric interface.
#pragma once

namespace fathom {

/// Power reflectance for light that arrives in a medium of index n_from at cos_from = cos θ ∈ [0, 1] on a medium of
/// index n_to: the mean of the s and p reflectances (Born & Wolf, Principles of Optics, §1.5). 1 on total internal
/// reflection. The transmittance of power is 1 minus this.
double fresnel_reflectance(double cos_from, double n_from, double n_to);

/// The same for diffuse light, ∫ R(cos θ) 2 cos θ d cos θ over the hemisphere. Relative error of 1 minus it below 1e-6
/// for index ratios up to 3.
double hemispherical_reflectance(double n_from, double n_to);

}  // namespace fathom
