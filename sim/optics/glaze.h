// Glazed earthenware: a clear coat with a smooth or rough surface over a Lambertian base.
//
// What the surface does not reflect enters, is scattered by the base, and leaves, or is reflected back by the surface
// from within, again and again (Saunderson 1942; as a BRDF Elias & Simonot 2004):
//     f_diffuse = T(θ_from) T(θ_to) ρ / (π n² (1 − ρ r)),
// T = 1 − reflectance of the surface, n = n_coat / n_outside, r = the surface's reflectance for diffuse light from
// within. Since light takes the same paths both ways, n² (1 − r) = ∫ T(θ) 2 cos θ d cos θ. The coat absorbs nothing and
// is thin against everything else. Reciprocal, and with ρ = 1 all light comes back.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/rng.h"
#include "sim/optics/ggx.h"

namespace fathom {

class Glaze {
 public:
  /// ρ = `base_albedo` in [0, 1] of the base within the coat; roughness α as in ggx.h, smooth below kSmooth.
  Glaze(double base_albedo, double roughness, double n_outside, double n_coat);

  /// Power reflectance of the surface alone for light that arrives at cos θ: Fresnel's when smooth, else the integral
  /// of ggx_reflection, tabulated to 1e-3 of itself. Light that facets throw at each other counts as entering.
  double surface_reflectance(double cosine) const;

  /// BRDF [1/sr] of the light that comes out of the coat; 0 below the horizon.
  double diffuse(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// BRDF [1/sr] with the surface's reflection, but for a smooth surface's mirror image, which is no density.
  double reflection(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// All light that comes back of what arrives at cos θ.
  double albedo(double cosine) const;

  /// One of the ways on which it does: a mirror image in the surface or diffuse light, each as often as it is strong.
  /// The mean weight is the albedo. Nothing where a rough surface would send the light into itself.
  std::optional<GgxSample> sample(const Eigen::Vector3d& from, Rng& rng) const;

 private:
  double base_albedo_, roughness_, n_outside_, n_coat_;
  std::vector<double> reflectance_;  ///< of a rough surface, at cosines (i / last)²
  double leaving_;                   ///< ρ (1 − r) / (1 − ρ r): share of what enters that comes out
  double mean_transmittance_;        ///< ∫ T 2 cos θ d cos θ
};

}  // namespace fathom
