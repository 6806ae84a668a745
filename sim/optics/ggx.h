// Reflection at rough glaze: microfacets of Trowbridge and Reitz's distribution ("GGX").
//
// Directions are unit vectors in the surface's frame, z its normal, and point away from the surface. The roughness α is
// the scale of the facets' slopes s, which follow α² / (π (α² + |s|²)²). α below kSmooth is a mirror.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace fathom {

/// Below this roughness a glaze is taken for smooth: its lobe, about α wide, is finer than any pixel of the sensor
/// (1/570 rad).
inline constexpr double kSmooth = 1e-4;

/// Density D of the microfacets' normals [1/sr] per area of surface, isotropic; ∫ D cos θ dω = 1 over the hemisphere.
/// Trowbridge & Reitz 1975; Walter et al. 2007, Eq. 33. α > 0.
double ggx_density(const Eigen::Vector3d& normal, double alpha);

/// Smith's auxiliary Λ(direction) = (√(1 + α² tan² θ) − 1) / 2 (Heitz 2014, Eq. 72); G1 = 1 / (1 + Λ) is the share of
/// facets that a direction sees.
double ggx_lambda(const Eigen::Vector3d& direction, double alpha);

/// Share of facets that both directions see, masking and shadowing correlated by height: 1 / (1 + Λ(a) + Λ(b)) (Heitz
/// 2014, Eq. 99).
double ggx_visibility(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double alpha);

/// BRDF [1/sr] of a rough dielectric of index n_to under a medium of n_from, F D G / (4 cos cos) (Walter et al. 2007,
/// Eq. 20). Single reflections only: light that would leave after a second one is lost. 0 below the horizon. α >
/// kSmooth.
double ggx_reflection(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double alpha, double n_from, double n_to);

/// A facet's normal among those that `from` sees, by two uniform numbers in [0, 1): the spherical cap of Dupuy &
/// Benyoub 2023. cos θ of `from` > 0.
Eigen::Vector3d sample_visible_normal(const Eigen::Vector3d& from, double alpha, double u1, double u2);

/// Density [1/sr] of sample_visible_normal: G1(from) max(0, from·normal) D(normal) / cos θ_from (Heitz 2018, Eq. 3).
double visible_normal_pdf(const Eigen::Vector3d& from, const Eigen::Vector3d& normal, double alpha);

struct GgxSample {
  Eigen::Vector3d to;
  double weight;  ///< BRDF · cos θ_to / pdf; with roughness it is F G2 / G1
};

/// A direction of reflection by sample_visible_normal; a smooth surface's only one. Nothing when the reflected light
/// would go into the surface.
std::optional<GgxSample> sample_ggx_reflection(const Eigen::Vector3d& from, double alpha, double n_from, double n_to,
                                               double u1, double u2);

/// Density [1/sr] of sample_ggx_reflection's directions for α > kSmooth: that of the half vector over 4 |from·half|.
double ggx_reflection_pdf(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double alpha);

}  // namespace fathom
