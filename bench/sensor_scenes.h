// The scenes in which the simulated sensor is measured as real ones were.
#pragma once

#include <string>

#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// A Kinect v1 over the desk of the measured clouds: 594 mm, pitched by 34.5°. `more` goes into the scene.
Setup desk_twin(const std::string& more = "");

/// A matte wall that a Kinect v1 faces, `distance` [m] away along its axis; the middle quarter of its image. Turned by
/// `tilt_deg` about a horizontal line, it does not lie on one step of disparity.
Setup facing_wall(double distance, double tilt_deg = 0.0);

/// The same, whole, with a glTF file's things before it, `z_mm` from the wall.
Setup wall_with(double distance, const std::string& gltf, double z_mm, double tilt_deg = 0.0);

Frame shoot(const Setup& setup, std::uint64_t seed, CaptureMode mode = CaptureMode::photometric);

/// Share of pixels with a depth among those at least `border` from every edge.
double valid_share(const Image<float>& depth, int border);

/// What changes from frame to frame of a still scene.
struct TemporalNoise {
  double median_mm, mean_mm;  ///< of the deviations of those pixels' depths that half of the frames have
  double valid;               ///< share of pixels with a depth, over all frames, inside the border
};

/// Of sixteen frames.
TemporalNoise temporal_noise(Camera& camera);

}  // namespace fathom
