// Where the light of a beam goes that falls on layers: the quantities that radiative transfer is certified by.
#pragma once

#include <cstdint>
#include <optional>

#include "core/sampling.h"
#include "sim/optics/layers.h"

namespace fathom {

/// Shares of the power of a collimated, unpolarised beam.
struct LayerLight {
  double specular = 0.0;   ///< reflected at the first surface, by Fresnel; part of the reflectance
  Estimate reflectance;    ///< all that goes up
  Estimate transmittance;  ///< all that goes down, scattered or not
  /// From its own tally at the scatterings, not from what is left; nothing where a layer absorbs without scattering.
  std::optional<Estimate> absorptance;
  std::uint64_t walks = 0;
  bool reached = true;  ///< the errors of the plan, of reflectance and transmittance
};

/// The beam falls from outside at `angle` ∈ [0, π/2) [rad] to the normal. Layers without any absorption over one of
/// infinite thickness that scatters give all light back: a walk returns with certainty, though after a time without
/// mean, so nothing is sampled. The same needs an absorbing lowest layer when another layer absorbs: Error otherwise.
LayerLight light_in_layers(const LayerSpace& space, double angle, std::uint64_t seed, const SamplingPlan& plan);

}  // namespace fathom
