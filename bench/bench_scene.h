// The scenes that are measured, ready to be traced.
#pragma once

#include <Eigen/Core>
#include <vector>

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

/// The same with images cut down to their middle; whole depth pixels, so both sizes are even.
Setup crop(Setup setup, int ir_width, int ir_height);

/// Infrared pixels whose depth pixel sees a cup or a liquid.
std::vector<Eigen::Vector2i> pixels_on_cups(const PointLight& projector, const Rig& rig);

/// Samples along each side of an infrared pixel: 4 samples per pixel, as `fathom capture` takes them.
inline constexpr int kSamplesAcross = 2;

}  // namespace fathom
