// What one builds of the Point Cloud Library by its tutorials to find cups on a desk: the largest plane, a voxel grid
// of 3 mm, Euclidean clusters of 40 mm, ICP of each to the templates.
#pragma once

#include <vector>

#include "detector/cloud.h"
#include "detector/cup_template.h"

namespace fathom {

/// The mean squared distance of each cluster to its best template.
std::vector<double> pcl_pipeline(const Cloud& cloud, const std::vector<CupTemplate>& templates);

}  // namespace fathom
