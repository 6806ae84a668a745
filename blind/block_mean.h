// What a block matcher makes of the dots: the mean disparity of those in a window that agree.
#pragma once

#include <vector>

#include "blind/follow.h"

namespace fathom::blind {

/// The error of a dot is that of its grain of speckle: it stays while nothing moves, and a smaller part is new in every
/// frame. With the steps of 1/8 px and the slope of a desk this gives 0.7 steps at 0.65 m.
inline constexpr double kStaticDotPx = 0.10;
inline constexpr double kTemporalDotPx = 0.067;

struct Member {
  int dot;              ///< index into Matched::dots
  double weight;        ///< those of a block add up to 1
  double error_weight;  ///< so do these: of errors, which rows far from the middle share less (measured: 3 to 4 rows)
};

struct Block {
  Eigen::Vector2d pixel;  ///< middle of the window
  double disparity_px = 0.0;
  double light = 0.0;        ///< of all its dots
  double brightness = 0.0;   ///< of a dot, each by its light: faint ones beside bright ones change nothing
  Lit lit = Lit::desk;       ///< what most of its dots stand on
  int first = 0, count = 0;  ///< its members
};

struct Matched {
  std::vector<SeenDot> dots;
  std::vector<double> dot_sigma;  ///< error of each dot in units of the constants above
  std::vector<Block> blocks;      ///< only those that are valid
  std::vector<Member> members;
};

/// Windows about every `stride`-th pixel of the rectangle. `speckle` keys the brightness of grains.
struct Raster {
  Eigen::Vector2i low, high;
  int stride;
};
Matched match(const World& world, const std::vector<Dot>& dots, bool has_cup, const Raster& raster,
              std::uint64_t speckle);

/// Projector's dots that can be seen in the raster on what stands between two depths [m].
std::vector<Dot> dots_for(const Sensor& sensor, const Raster& raster, double near, double far);

/// Infrared digital number of every block's middle pixel: of 10 bits, dots and what is between them.
std::vector<float> infrared_dn(const Matched& matched);

}  // namespace fathom::blind
