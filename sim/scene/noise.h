// What turns even radiance into digital numbers that are not: speckle, the detector, ambient light; and statistics for
// captures without an image.
#pragma once

#include "core/json_fwd.h"

namespace fathom {

/// Statistics that stand in for the image chain where no image is made (CaptureMode::geometric): of the disparity, as
/// measured desks show them, not derived from light. See sim/sensor/disparity_noise.h.
struct DisparityNoise {
  double facing_px = 0.0;   ///< standard deviation on a surface that faces the sensor, far away
  double lateral_px = 0.0;  ///< of the place that a pixel reads, along each axis
  double renewed = 0.0;     ///< share of both variances that each frame draws anew

  bool present() const { return facing_px > 0.0 || lateral_px > 0.0; }

  bool operator==(const DisparityNoise&) const = default;
};

/// All parts at their defaults: an ideal camera.
struct NoiseModel {
  double speckle_shape = 0.0;  ///< of the dots' brightness, Gamma distributed; 0 = none
  double speckle_mean = 1.0;   ///< its mean
  double pixel_speckle = 0.0;  ///< share of the light that is coherent, so makes grains on the pixels (see OpticsModel)
  double reference_speckle = 0.0;  ///< the same in the image of the reference plane that the sensor remembers
  double speckle_renewed = 0.0;    ///< share of the pixels' speckle that each frame draws anew; 0 = a static scene's
  double ambient_dn = 0.0;         ///< ambient infrared light on a surface of albedo 1 [DN]
  double gain = 1.0;               ///< of exposure and amplifier, over that of SensorModel::radiant_dn_mm2
  double electrons_per_dn = 0.0;   ///< at gain 1. Shot noise: variance = signal · gain / this [DN²]; 0 = none
  double read_dn = 0.0;            ///< standard deviation of the detector's own noise, after the gain [DN]
  double offset_dn = 0.0;          ///< its mean [DN]
  double bloom_share = 0.0;        ///< share of the light above saturation that spills over to the pixels around
  double bloom_ir_px = 4.0;        ///< mean distance along each axis that it spills
  int bits = 0;                    ///< rounding, and saturation at 2^bits − 1; 0 = none
  DisparityNoise disparity;        ///< of geometric captures only

  bool operator==(const NoiseModel&) const = default;
};

/// A preset's name, or an object of parts: what it does not name is off.
NoiseModel noise_from_json(const JsonReader& json);
Json json_from_noise(const NoiseModel& noise);
std::vector<std::string> noise_presets();
std::vector<KeyRow> noise_keys();
std::vector<KeyRow> disparity_noise_keys();

/// The noise that sensors have whose files name none.
NoiseModel basic_noise();

}  // namespace fathom
