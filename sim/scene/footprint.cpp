#include "sim/scene/footprint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/geometry/algorithms/convex_hull.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/algorithms/simplify.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>

namespace fathom {
namespace {

using Point = boost::geometry::model::d2::point_xy<double>;
using Polygon = boost::geometry::model::polygon<Point>;

Polygon polygon_of(const std::vector<Eigen::Vector2d>& corners) {
  Polygon polygon;
  for (const Eigen::Vector2d& corner : corners) polygon.outer().emplace_back(corner.x(), corner.y());
  return polygon;
}

}  // namespace

Footprint::Footprint(const std::vector<GltfPart>& parts) {
  constexpr double kSimplified = 1e-4;
  boost::geometry::model::multi_point<Point> points;
  for (const GltfPart& part : parts)
    for (const Eigen::Vector3d& vertex : part.mesh.vertices) points.emplace_back(vertex.x(), vertex.y());
  Polygon hull, simple;
  boost::geometry::convex_hull(points, hull);
  boost::geometry::simplify(hull, simple, kSimplified);
  for (const Point& point : simple.outer()) corners_.emplace_back(point.x(), point.y());
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : corners_) box.extend(corner);
  centre_ = box.center();
  for (const Eigen::Vector2d& corner : corners_) radius_ = std::max(radius_, (corner - centre_).norm());
}

Footprint Footprint::placed(const Eigen::Vector2d& position, double yaw) const {
  Footprint moved = *this;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(yaw).toRotationMatrix();
  for (Eigen::Vector2d& corner : moved.corners_) corner = turn * corner + position;
  moved.centre_ = turn * centre_ + position;
  return moved;
}

double Footprint::distance(const Footprint& other) const {
  return boost::geometry::distance(polygon_of(corners_), polygon_of(other.corners_));
}

bool Footprint::is_within(double distance, const Footprint& other) const {
  constexpr double kRounding = 1e-9;  // [m]
  const double between_circles = (centre_ - other.centre_).norm() - radius_ - other.radius_;
  return between_circles < distance + kRounding && this->distance(other) < distance;
}

}  // namespace fathom
