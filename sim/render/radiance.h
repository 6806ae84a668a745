// The radiometric constant that joins the projector's power, the camera's gain and Lambert's law.
#pragma once

#include "sim/render/connection.h"
#include "sim/scene/rig.h"

namespace fathom {

/// Digital number [DN] of radiance that is reflected / π per unit radiant intensity of the projector; `reflected`
/// [1/m²] is albedo · irradiance · transmittance. On a bare surface that is radiant_dn_mm2 · albedo · cos θ / r² with
/// r in mm (Landau 2016).
inline double radiance_dn(const SensorModel& sensor, double reflected) {
  constexpr double kSquareMetresPerSquareMm = 1e-6;
  return sensor.radiant_dn_mm2 * kSquareMetresPerSquareMm * reflected;
}

/// The same of a dot's centre on a surface.
inline double radiance_dn(const SensorModel& sensor, const SeenPoint& seen, const Illumination& light) {
  return radiance_dn(sensor, light.reflectance * light.irradiance * seen.transmittance);
}

}  // namespace fathom
