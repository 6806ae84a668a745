// Segments: points closer together than a distance belong to the same object. Paper, section V-C.
#pragma once

#include <vector>

#include "detector/cloud.h"

namespace fathom {

/// Groups of points connected by steps of at most `distance_m`, each of at least `points_min` points, the largest
/// first.
std::vector<Points> euclidean_clusters(const Points& points, double distance_m, int points_min);

}  // namespace fathom
