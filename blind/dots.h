// The dots that the projector throws: a pattern with the statistics of the published one.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fathom::blind {

/// Dots whose place in the projector's image (pixels of the depth image, same centre) lies in [low, high): tiles of
/// 211 × 165 positions, 11.1 % of them lit, no two touching. `number` is a dot's own.
struct Dot {
  Eigen::Vector2d at;
  int number;
};
std::vector<Dot> dots_in(const Eigen::Vector2i& low, const Eigen::Vector2i& high);

/// Dots per pixel.
double dot_density();

}  // namespace fathom::blind
