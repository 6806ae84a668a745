// Every effect of the registry, one function in one file each. A new one: docs/effects.md.
#pragma once

#include "sim/effects/effect.h"

namespace fathom::effects {

Effect sensor_height();
Effect sensor_pitch();
Effect sensor_roll();
Effect baseline();
Effect focal_length();
Effect principal_point();
Effect disparity_offset();
Effect radial_distortion();
Effect depth_quantization();
Effect thermal_drift();
Effect depth_wander();
Effect depth_step_phase();
Effect depth_truncation();
Effect noise_correlation();
Effect reference_residue();
Effect refractive_index();
Effect absorption();
Effect subsurface_scattering();
Effect stratification();
Effect meniscus();
Effect surface_tilt();
Effect foam();
Effect ripples();
Effect cup_bottom_height();
Effect concave_bottom();
Effect wall_albedo();
Effect cup_placement();
Effect wall_multipath();
Effect specular_ghost();
Effect fill_offset();
Effect fill_scale();
Effect evaporation();
Effect label_swap();
Effect unit_error();
Effect wrong_cup();
Effect window_averaging();
Effect skew_approximation();
Effect colour_registration();

}  // namespace fathom::effects
