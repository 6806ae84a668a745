// The scenes that are measured, ready to be traced.
#pragma once

#include "sim/render/light.h"
#include "sim/scene/setup.h"

namespace fathom {

struct BenchScene {
  explicit BenchScene(Setup described);

  Setup setup;
  Geometry geometry;
  Intersector world;
  PointLight projector;
};

/// scenes/paper_water.json.
Setup paper_water();

/// The same without the cup: the desk alone, a slanted plane.
Setup slanted_plane();

/// Samples along each side of an infrared pixel: 4 samples per pixel, as `fathom capture` takes them.
inline constexpr int kSamplesAcross = 2;

}  // namespace fathom
