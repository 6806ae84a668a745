// Fast point feature histograms: what the surface about a point is like, whichever way it is turned.
#pragma once

#include <array>
#include <vector>

#include "detector/cloud.h"

namespace fathom {

/// Three histograms of 11 bins, in percent.
using Fpfh = std::array<float, 33>;

struct Neighbour {
  int index;
  float squared_distance;  ///< [m²]
};

/// Of each point (Rusu, Blodow & Beetz 2009, ICRA). `normals` are of unit length; `neighbours` of each point are all
/// within some radius, the point itself among them.
std::vector<Fpfh> fast_point_feature_histograms(const Points& points, const Points& normals,
                                                const std::vector<std::vector<Neighbour>>& neighbours);

}  // namespace fathom
