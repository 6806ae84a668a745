// How much of the image each point of a thinned cloud stands for, and a cloud thinned alike everywhere.
#pragma once

#include <span>

#include "diagnosis/measurement/frame_estimates.h"

namespace fathom {

/// Sets the points' weights to the pixels that each stands for: the square of its distance along rows and columns to
/// the second nearest other point. On any grid that is the grid's cell, so what was thinned here and not there counts
/// by the area it covers. A point far from all others stands for no more than a square of 16 pixels.
void weigh_by_sampling(std::span<SensedPoint> points, double focal_px);

/// One point of each square of the image that is as wide as points are apart in the middle of the image's area. All of
/// them where they are as dense as pixels there.
Points thinned_evenly(Points points, double focal_px);

}  // namespace fathom
