// The yardstick: Embree asked for one recorded ray after the other, with nothing around it.
#pragma once

#include <cstdint>
#include <memory>

#include "bench/ray_recorder.h"
#include "sim/scene/geometry.h"

namespace fathom {

class EmbreeLoop {
 public:
  /// Builds the two scenes of sim/render (all surfaces; opaque ones) with the same flags.
  explicit EmbreeLoop(const Geometry& geometry);
  ~EmbreeLoop();
  EmbreeLoop(const EmbreeLoop&) = delete;
  EmbreeLoop& operator=(const EmbreeLoop&) = delete;

  /// Traces every ray, rows in parallel; returns how many hit.
  std::uint64_t trace(const Recording& recording) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fathom
