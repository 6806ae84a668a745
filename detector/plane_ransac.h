// RANSAC for planes on a draw of the points, least squares on all of them.
#pragma once

#include <functional>
#include <optional>

#include "detector/plane.h"

namespace fathom {

/// One point out of each of `count` equal parts of the cloud, the measured ones of these: spread over the image, but
/// not in its rows.
Points draw_points(const Points& points, int count);

/// The plane within whose threshold the most points lie, of those that pass three points and may be one; refined by
/// least squares. Nothing when there is none. Equal points and rounds give equal planes.
std::optional<Plane> largest_plane(const Points& points, double threshold_m, int iterations_max, int round,
                                   const std::function<bool(const Plane&)>& may_be);

/// Total least squares of the points within the threshold of a plane; the plane itself when they are fewer than three.
PlaneFit fit_plane(const Points& points, const Plane& plane, double threshold_m);

int count_inliers(const Points& points, const Plane& plane, double threshold_m);
void erase_inliers(Points& points, const Plane& plane, double threshold_m);

}  // namespace fathom
