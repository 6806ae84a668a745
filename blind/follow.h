// The dots that the projector throws, a pattern with the statistics of the published one, and a dot's way: from the
// projector to what it lights, and from there to the camera.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "blind/eye.h"
#include "blind/world.h"

namespace fathom::blind {

struct Dot {
  Eigen::Vector2d at;  ///< in the projector's image: pixels of the depth image, same centre
  int number;          ///< its own
};
/// Dots that lie in [low, high), of tiles of 211 × 165 positions, 11.1 % of them lit, no two touching.
std::vector<Dot> dots_in(const Eigen::Vector2i& low, const Eigen::Vector2i& high);

enum class Lit { desk, outer_wall, rim, inner_wall, bottom, surface };

struct SeenDot {
  Eigen::Vector2d pixel;  ///< in the camera's image
  double disparity_px;    ///< as the device takes it
  double brightness;      ///< 1: the desk's, straight below, at 0.7 m
  Lit lit;
  int number;  ///< the pattern's; ghosts have the number of their dot
};

/// What the camera sees of a dot: nothing, one dot, or more where something mirrors.
void follow(const World& world, const Eyes& eyes, const Dot& dot, bool has_cup, std::vector<SeenDot>& seen);

}  // namespace fathom::blind
