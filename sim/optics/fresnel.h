// Fresnel's equations at a smooth dielectric interface.
#pragma once

namespace fathom {

/// Power reflectances for light that is polarised across the plane of incidence and in it.
struct PolarisedReflectance {
  double s, p;
};

/// Fresnel's equations (Born & Wolf, Principles of Optics, §1.5) for light that arrives in a medium of index n_from at
/// cos_from = cos θ ∈ [0, 1] on a medium of index n_to. Both 1 on total internal reflection.
PolarisedReflectance polarised_reflectance(double cos_from, double n_from, double n_to);

/// The same for unpolarised light: the mean of the two. The transmittance of power is 1 minus this.
double fresnel_reflectance(double cos_from, double n_from, double n_to);

/// The same for diffuse light, ∫ R(cos θ) 2 cos θ d cos θ over the hemisphere. Relative error of 1 minus it below 1e-6
/// for index ratios up to 3.
double hemispherical_reflectance(double n_from, double n_to);

}  // namespace fathom
