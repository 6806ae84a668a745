#include "sim/effects/registry.h"

#include "core/error.h"
#include "sim/effects/effects.h"

namespace fathom {

const std::vector<Effect>& effect_registry() {
  static const std::vector<Effect> registry{effects::sensor_height(),
                                            effects::sensor_pitch(),
                                            effects::sensor_roll(),
                                            effects::baseline(),
                                            effects::focal_length(),
                                            effects::principal_point(),
                                            effects::disparity_offset(),
                                            effects::radial_distortion(),
                                            effects::depth_quantization(),
                                            effects::thermal_drift(),
                                            effects::depth_wander(),
                                            effects::depth_step_phase(),
                                            effects::depth_truncation(),
                                            effects::noise_correlation(),
                                            effects::reference_residue(),
                                            effects::refractive_index(),
                                            effects::absorption(),
                                            effects::subsurface_scattering(),
                                            effects::stratification(),
                                            effects::meniscus(),
                                            effects::surface_tilt(),
                                            effects::foam(),
                                            effects::ripples(),
                                            effects::cup_bottom_height(),
                                            effects::concave_bottom(),
                                            effects::wall_albedo(),
                                            effects::cup_placement(),
                                            effects::wall_multipath(),
                                            effects::specular_ghost(),
                                            effects::fill_offset(),
                                            effects::fill_scale(),
                                            effects::evaporation(),
                                            effects::label_swap(),
                                            effects::unit_error(),
                                            effects::wrong_cup(),
                                            effects::window_averaging(),
                                            effects::skew_approximation(),
                                            effects::colour_registration()};
  return registry;
}

std::vector<std::string> effect_ids() {
  std::vector<std::string> ids;
  for (const Effect& effect : effect_registry()) ids.emplace_back(effect.id);
  return ids;
}

const Effect* find_effect(std::string_view id) {
  for (const Effect& effect : effect_registry())
    if (effect.id == id) return &effect;
  return nullptr;
}

}  // namespace fathom
