// What becomes of a walker at a smooth interface, where Fresnel's share is reflected and the rest refracted, and at a
// diffuse wall.
#pragma once

#include <algorithm>

#include "core/rng.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/random_walk.h"
#include "sim/optics/snell.h"

namespace fathom {

/// Reflects the walker with the probability of Fresnel's reflectance, else refracts it. `normal`: unit, on the side
/// that it comes from. True when it went through; the caller sets the region.
inline bool cross_interface(Walker& walker, const Eigen::Vector3d& normal, double n_from, double n_to, Rng& rng) {
  if (n_from == n_to) return true;
  const double cos_from = std::clamp(-walker.direction.dot(normal), 0.0, 1.0);
  if (rng.uniform() >= fresnel_reflectance(cos_from, n_from, n_to))
    if (const auto refracted = refract(walker.direction, normal, n_from, n_to)) {
      walker.direction = *refracted;
      return true;
    }
  walker.direction = reflect(walker.direction, normal);
  return false;
}

/// An interface to the outside, where the walk is not followed: the visitor is told of the share that leaves,
/// `leaves(walker, normal, weight)` with the walker as it arrives, and the rest is reflected. Better than a choice
/// between the two, as nothing that leaves is left to chance.
template <class Visitor>
void leave_through(Walker& walker, const Eigen::Vector3d& normal, double n_from, double n_to, Visitor& visitor) {
  const double cos_from = std::clamp(-walker.direction.dot(normal), 0.0, 1.0);
  const double reflectance = fresnel_reflectance(cos_from, n_from, n_to);
  if (reflectance < 1.0) visitor.leaves(walker, normal, (1.0 - reflectance) * walker.weight);
  walker.weight *= reflectance;
  walker.direction = reflect(walker.direction, normal);
}

/// A diffuse wall: the visitor is told, `at_wall(walker, normal, albedo)`, with the walker as it arrives; then what the
/// wall reflects is sent back.
template <class Visitor>
void bounce_off_wall(Walker& walker, const Eigen::Vector3d& normal, double albedo, Rng& rng, Visitor& visitor) {
  visitor.at_wall(walker, normal, albedo);
  walker.weight *= albedo;
  walker.direction = sample_diffuse(normal, rng);
}

}  // namespace fathom
