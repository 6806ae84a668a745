// The rays that a capture fires, told again from what it found, so that a bare Embree loop can trace the same ones.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/intersect.h"
#include "sim/scene/rig.h"

namespace fathom {

enum class RayKind : std::uint32_t { camera, refracted, occluded };

struct RecordedRay {
  float origin[3];
  float direction[3];
  float far;
  RayKind kind;
};

struct Recording {
  std::vector<std::vector<RecordedRay>> rows;  ///< by image row, in the order in which they are fired
  std::uint64_t hits = 0;                      ///< rays that meet a surface

  std::uint64_t rays() const;
};

/// What trace_truth() fires: camera rays, refracted rays and shadow rays of all depth pixels. A refracted ray that
/// leaves the scene is left out; it can be no more than a few at a liquid's rim.
Recording record_truth(const Intersector& world, const Rig& rig);

/// What render_ir() fires for `samples_across`² samples per infrared pixel.
Recording record_render(const Intersector& world, const Rig& rig, int samples_across);

/// Its camera rays alone.
Recording record_camera_rays(const Intersector& world, const Rig& rig, int samples_across);

}  // namespace fathom
