// What the page knows of every pixel: where its point really is, where its straight rays meet, what was measured, and
// every bend of its two rays.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/json.h"
#include "sim/render/light.h"
#include "sim/scene/setup.h"
#include "view/packed.h"

namespace fathom {

/// The bends of one pixel's rays [m] in the world.
struct BentPixel {
  std::uint32_t pixel;  ///< number of it in the table
  std::vector<Eigen::Vector3d> camera, projector;
  double paper_height;  ///< [m] in the world, where the paper's Eq. 7 has the point; NaN where it does not hold
};

/// Of every `stride`-th pixel of every `stride`-th row, row by row.
struct PixelTable {
  int stride, columns, rows;
  std::vector<std::uint8_t> path;       ///< PathKind
  std::vector<std::uint16_t> object;    ///< as in Surface, of the true point
  std::vector<Eigen::Vector3d> points;  ///< [m] world; 0 where nothing is seen
  std::vector<double> apparent_depth;   ///< [m] camera frame, as TruePixel; 0: none
  std::vector<double> measured_depth;   ///< [m] camera frame; 0: none
  std::vector<BentPixel> bent;          ///< by rising number

  double farthest() const;  ///< [m] greatest coordinate of all points and bends, by amount
};

/// Traces the rays again of what was captured. `depth` [m] has the sensor's size, 0 = invalid.
PixelTable trace_pixels(const Setup& setup, const PointLight& projector, const Image<float>& depth);

/// The table's part of the page's data.
Json json_from_pixels(const PixelTable& table, const PlaceCode& code);

}  // namespace fathom
