// A standing scene as the infrared camera sees it: rendered once, then exposed and matched frame by frame.
#pragma once

#include <cstdint>
#include <memory>

#include "core/image.h"
#include "sim/render/light.h"
#include "sim/scene/rig.h"
#include "sim/sensor/ir_camera.h"
#include "sim/sensor/pattern.h"
#include "sim/sensor/reference.h"

namespace fathom {

/// Wall-clock times [s] and counts of what a capture did, for run.json.
struct CaptureStatistics {
  double build_s = 0, truth_s = 0, reference_s = 0, render_s = 0, match_s = 0, depth_s = 0;
  std::uint64_t camera_rays = 0;  ///< traced from the camera, truth included
};

struct ImagedFrame {
  Image<float> ir;            ///< [DN] ir_width × ir_height
  Image<float> disparity_px;  ///< as matched; 0 = invalid
};

class ImagedView {
 public:
  /// Renders with `samples_across`² samples per infrared pixel, and the pattern as speckle leaves it.
  ImagedView(const PointLight& projector, const Rig& rig, const Pattern& pattern,
             std::shared_ptr<const Reference> reference, int samples_across, LightModel light, std::uint64_t seed,
             CaptureStatistics& statistics);

  /// The frame of that number; only the noise differs from frame to frame.
  ImagedFrame shoot(std::uint64_t frame, CaptureStatistics& statistics) const;

  const SensorModel& sensor() const { return sensor_; }
  /// What every infrared pixel receives from the projector before noise and speckle on pixels [DN].
  const Image<float>& radiance() const { return light_.projected; }

 private:
  SensorModel sensor_;
  std::shared_ptr<const Reference> reference_;
  std::uint64_t seed_;
  IrLight light_;
  Image<float> speckle_;  ///< of the static scene; empty: none
};

}  // namespace fathom
