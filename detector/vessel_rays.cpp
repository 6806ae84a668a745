#include "detector/vessel_rays.h"

#include <algorithm>

namespace fathom {
namespace {

double share(int part, double rest) { return part == 0 ? 0.0 : part / (part + rest); }

}  // namespace

double VesselRays::lid_share() const { return share(lid, static_cast<double>(inside.size())); }

double VesselRays::beyond_share() const { return share(beyond, wall + lid + static_cast<double>(inside.size())); }

VesselRays trace_vessel(const Points& points, double camera_height_m, const RoundWall& wall,
                        const VesselRaysSettings& settings) {
  const float height = static_cast<float>(camera_height_m), top = static_cast<float>(wall.top_m);
  const float tolerance = static_cast<float>(settings.tolerance_m), margin = static_cast<float>(settings.margin_m);
  const float rim = static_cast<float>(wall.radius_at(wall.top_m)),
              lid_floor = top - static_cast<float>(settings.lid_m);
  const Eigen::Vector2f center = wall.center.cast<float>();
  const float radius = static_cast<float>(wall.radius_m), lean = static_cast<float>(wall.lean);
  const auto radius_at = [&](float z) { return radius + lean * (z - static_cast<float>(kWallHeight)); };
  // Lines of sight that pass the axis farther away than this, seen from above, have nothing to say.
  const float widest = std::max(rim, radius_at(0.0f)) + tolerance;
  const float low = -0.1f;  // what reads deeper below the desk is no measurement of a scene on it

  VesselRays result;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2f line = point.head<2>();
    const float cross = line.x() * center.y() - line.y() * center.x();
    if (!(cross * cross <= widest * widest * line.squaredNorm()) || !(point.z() > low) || !(point.z() < height))
      continue;
    const Eigen::Vector2f off = line - center;
    const float distance = off.norm();
    if (point.z() > lid_floor) {  // ends too high for the inside
      if (distance < rim - margin)
        ++result.lid;
      else if (distance < rim + tolerance && point.z() < top + tolerance)
        ++result.wall;
      continue;
    }
    const bool nearer = line.dot(center) < center.squaredNorm() && distance > widest;
    if (nearer) continue;  // ends in front of the vessel
    const Eigen::Vector2f at_rim = line * ((height - top) / (height - point.z())) - center;
    const bool came_over_near_side = at_rim.dot(center) < 0.0f;
    if (at_rim.norm() < rim - margin) {
      if (distance < radius_at(point.z()) + tolerance)
        result.inside.push_back(point);
      else
        ++result.beyond;
    } else if (distance > radius_at(point.z()) - margin && distance < radius_at(point.z()) + tolerance) {
      ++result.wall;
    } else if (came_over_near_side && line.dot(center) > center.squaredNorm()) {
      // It passed below the near side of the rim and ends behind the axis: there was no wall, unless it passed beside.
      const float beside = radius_at(0.5f * top) - margin;
      result.beyond += cross * cross < beside * beside * line.squaredNorm();
    }
  }
  return result;
}

}  // namespace fathom
