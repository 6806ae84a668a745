// The radiometric constant that joins the projector's power, the camera's gain and Lambert's law.
#pragma once

#include "sim/render/connection.h"
#include "sim/scene/rig.h"

namespace fathom {

/// Digital number of a dot's centre [DN]: sensor.radiant_dn_mm2 · albedo · irradiance · transmittance. On a bare
/// surface that is radiant_dn_mm2 · albedo · cos θ / r² with r in mm (Landau 2016).
inline double radiance_dn(const SensorModel& sensor, const SeenPoint& seen, const Illumination& light) {
  constexpr double kSquareMetresPerSquareMm = 1e-6;
  return sensor.radiant_dn_mm2 * kSquareMetresPerSquareMm * seen.albedo * light.irradiance * seen.transmittance;
}

}  // namespace fathom
