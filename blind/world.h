// Everything that light meets on one placement of the cup, as it truly is. Metres and radians; camera pixels are those
// of the depth image. Written from the physics alone: nothing of Fathom's optics, scenes or sensors is used here.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "blind/unit.h"

namespace fathom::blind {

/// The unit as it was built, not as its table of depths supposes (`device_law.h`).
struct Sensor {
  double height = 0.650;  ///< of the baseline's middle above the desk
  double pitch = 0.0;     ///< 0: level, π/2: straight down
  double roll = 0.0;      ///< about the optical axis, the right side down
  double baseline = 0.075;
  double focal_px = 570.342;
  Eigen::Vector2d principal_px{320.0, 240.0};
  double radial_k1 = 0.0;  ///< x' = x (1 + k1 r²) in tangents, in the memorised image as well
  double disparity_offset_px = 0.0;
  double steps_per_px = 8.0;  ///< of the matcher
  int window_px = 9;          ///< side of the block that is correlated
};

struct Liquid {
  double index = 1.0;
  double absorption = 0.0;          ///< [1/m]
  double reduced_scattering = 0.0;  ///< [1/m]; 0: clear, the bottom is seen
  double deep_index_excess = 0.0;   ///< index of the lower half minus that of the upper
};

/// The liquid's top: level + what is added here, in the cup's frame.
struct Top {
  double contact_angle = 1.5707963267948966;  ///< 90°: no meniscus
  double capillary_length = 0.00273;
  double slope_x = 0.0, slope_y = 0.0;
  double ripple_amplitude = 0.0, ripple_length = 0.012, ripple_phase = 0.0;
  double foam_cover = 0.0, foam_thickness = 0.0;
};

struct Cup {
  Eigen::Vector2d centre{0.0, 0.4};  ///< its axis on the desk
  double height = 0.087, inner_radius = 0.040, outer_radius = 0.043, bottom = 0.007;
  double dish = 0.0;  ///< how much lower the bottom's middle is than its edge
  double wall_albedo = 0.70;
  double wall_gloss = 0.0;  ///< share of the light on the inner wall that goes on as from a mirror
  double caustic = 0.0;     ///< [px] pull of the line of light that the round wall gathers on the bottom
};

/// What no entry of a registry describes and every set has a little of.
struct Dust {
  double pattern_bend_px =
      0.0;                 ///< the projector's pincushion, as it differs from the memorised one, at the image's edge
  double band_px = 0.0;    ///< disparity of bands of 16 rows
  double bright_px = 0.0;  ///< disparity of a dot twice as bright as the mean
};

/// What a registry does not know and the workflow has to call unknown.
struct Strange {
  double lens_patch_px = 0.0;  ///< disparity in the middle of a dirty spot of the lens
  Eigen::Vector2d lens_patch_at{320.0, 300.0};
  double rolling_px = 0.0;  ///< amplitude of a sine along the rows: they are exposed one by one while the stand sways
  double rolling_phase = 0.0;  ///< where in the sway the exposure starts
  double vibration_px = 0.0;   ///< amplitude of a sine along the rows, its phase new in every frame
};

struct World {
  Sensor sensor;
  Cup cup;
  std::optional<Liquid> liquid;
  double fill = 0.0;  ///< depth of the liquid above the bottom's edge
  Top top;
  double ghost_gain = 0.0;    ///< strength of the surface's mirror image on the wall, in Fresnel's
  double warm_up_px = 0.0;    ///< disparity too much at the session's start; fades in 600 s
  double wander_px = 0.0;     ///< 1 σ of what a whole frame's disparity is off
  double noise_scale = 1.0;   ///< of everything random in the device
  bool heavy_tails = false;   ///< errors of dots as Student's t of 4 instead of normal
  double seconds = 0.0;       ///< since the session began
  double since_poured = 0.0;  ///< [s]
  UnitBias unit{};
  Dust dust;
  Strange strange;
};

}  // namespace fathom::blind
